#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/records/log_file.h"

namespace godobject::firmware {

/// The name of a run: its start in UTC, as `20261130T143055Z`.
std::string run_name(std::chrono::system_clock::time_point start);

/// A small file of a record, as a whole.
struct RecordFile {
  std::string name;
  std::string text;
};

/// The file that tells what ran, in TOML.
inline constexpr const char* kRunFile = "run.toml";

/// A new folder for the files of one run. It never writes into a file or folder that exists, and it follows no symbolic
/// link below `parent`. Folders get mode 0750, files 0640; the umask may take more rights away.
class RecordFolder {
 public:
  /// Makes `parent` if it is missing, and in it the folder `name`. If that name is taken, the folder is `name`-2,
  /// `name`-3 and so on. Throws command::Failure (kIo) if a folder cannot be made.
  RecordFolder(const std::filesystem::path& parent, const std::string& name);
  ~RecordFolder();
  RecordFolder(const RecordFolder&) = delete;
  RecordFolder& operator=(const RecordFolder&) = delete;

  /// Makes an empty file. Throws command::Failure (kIo) if the name is taken or the file cannot be made.
  LogFile create(const std::string& name) const;

  /// Makes and writes the files. Throws as `create`.
  void write(const std::vector<RecordFile>& files) const;

  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Makes a folder for records and those above it, if they are missing. Throws command::Failure (kIo) if that fails, or
/// if this process may not make a folder in it.
void require_record_folder(const std::filesystem::path& folder);

/// Room that this process may use on the disk of a folder [bytes]. The folder need not exist yet. 0: not known.
std::uintmax_t room_on_disk(std::filesystem::path folder);

/// The links by which readers find the newest run in a folder of runs: LOGS/NAME links to latest/NAME, for each of the
/// `names`, and LOGS/latest links to the folder of the newest run. No file is replaced by a link.
class LatestLinks {
 public:
  /// Makes LOGS and its links to latest/NAME. Throws command::Failure (kIo) if a link cannot be made, or if LOGS has
  /// something else of that name.
  LatestLinks(const std::filesystem::path& logs, const std::vector<std::string>& names);

  /// Lets LOGS/latest link to a folder in LOGS, in one step. Throws command::Failure (kIo) if that fails.
  void point_to(const std::string& run) const;

 private:
  std::filesystem::path logs_;
};

}  // namespace godobject::firmware
