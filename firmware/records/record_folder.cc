#include "firmware/records/record_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

namespace fs = std::filesystem;
using command::ExitCode;
using command::Failure;

constexpr mode_t kFolderMode = 0750;
constexpr mode_t kFileMode = 0640;
constexpr int kMostOfOneName = 1000;  // runs that start in the same second, chosen
const char* const kLatest = "latest";

[[noreturn]] void fail_to_make_folder(const fs::path& folder, int error) {
  throw Failure(ExitCode::kIo, fmt::format("{}: cannot make this folder ({}); name another one", folder.string(),
                                           std::strerror(error)));
}

/// Makes a folder and those above it. Those that exist stay as they are.
void make_folders(const fs::path& folder) {
  std::error_code error;
  const fs::path above = folder.parent_path();
  if (!above.empty() && above != folder && !fs::exists(above, error)) make_folders(above);
  if (::mkdir(folder.c_str(), kFolderMode) == 0) return;
  const int failed = errno;
  if (!fs::is_directory(folder, error)) fail_to_make_folder(folder, failed == EEXIST ? ENOTDIR : failed);
}

/// Makes the folder under the first name that is free: `folder`, `folder`-2, `folder`-3.
fs::path make_new_folder(const fs::path& folder) {
  for (int i = 1; i <= kMostOfOneName; ++i) {
    const fs::path made = i == 1 ? folder : fs::path(fmt::format("{}-{}", folder.string(), i));
    if (::mkdir(made.c_str(), kFolderMode) == 0) return made;
    if (errno != EEXIST) fail_to_make_folder(made, errno);
  }
  fail_to_make_folder(folder, EEXIST);
}

/// True if `link` is a symbolic link to `target`.
bool links_to(const fs::path& link, const fs::path& target) {
  std::error_code error;
  return fs::read_symlink(link, error) == target;
}

}  // namespace

std::string run_name(std::chrono::system_clock::time_point start) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(start);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("{:04}{:02}{:02}T{:02}{:02}{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday, utc.tm_hour,
                     utc.tm_min, utc.tm_sec);
}

void require_record_folder(const fs::path& folder) {
  make_folders(folder);
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return;
  throw Failure(ExitCode::kIo,
                fmt::format("{}: cannot be written ({}); name another folder", folder.string(), std::strerror(errno)));
}

std::uintmax_t room_on_disk(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error);
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  const fs::space_info space = fs::space(folder, error);
  return error ? 0 : space.available;
}

RecordFolder::RecordFolder(const fs::path& parent, const std::string& name) {
  make_folders(parent);
  path_ = make_new_folder(parent / name);
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor_ < 0) fail_to_make_folder(path_, errno);
}

RecordFolder::~RecordFolder() { ::close(descriptor_); }

LogFile RecordFolder::create(const std::string& name) const {
  const int file =
      ::openat(descriptor_, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_APPEND | O_CLOEXEC, kFileMode);
  if (file < 0) {
    throw Failure(ExitCode::kIo, fmt::format("{}: cannot be written ({}); check the folder", (path_ / name).string(),
                                             std::strerror(errno)));
  }
  return LogFile(path_ / name, file);
}

void RecordFolder::write(const std::vector<RecordFile>& files) const {
  for (const RecordFile& file : files) create(file.name).write(file.text, 1);
}

LatestLinks::LatestLinks(const fs::path& logs, const std::vector<std::string>& names) : logs_(logs) {
  make_folders(logs);
  for (const std::string& name : names) {
    const fs::path link = logs / name;
    const fs::path target = fs::path(kLatest) / name;
    if (::symlink(target.c_str(), link.c_str()) == 0 || (errno == EEXIST && links_to(link, target))) continue;
    if (errno == EEXIST) {
      throw Failure(ExitCode::kIo,
                    fmt::format("{}: is not a link to {}, perhaps a log of an older version; move it away or name "
                                "another folder",
                                link.string(), target.string()));
    }
    throw Failure(ExitCode::kIo, fmt::format("{}: cannot make this link ({}); name another folder", link.string(),
                                             std::strerror(errno)));
  }
  if (const fs::path latest = logs / kLatest; fs::exists(fs::symlink_status(latest)) && !fs::is_symlink(latest)) {
    throw Failure(ExitCode::kIo,
                  fmt::format("{}: is not a link; move it away or name another folder", latest.string()));
  }
}

void LatestLinks::point_to(const std::string& run) const {
  const fs::path latest = logs_ / kLatest;
  const fs::path next = logs_ / fmt::format(".{}-{}", kLatest, ::getpid());
  std::error_code ignored;
  if (fs::is_symlink(next)) fs::remove(next, ignored);  // of a process with this number that was killed
  if (::symlink(run.c_str(), next.c_str()) == 0 && ::rename(next.c_str(), latest.c_str()) == 0) return;
  const int error = errno;
  throw Failure(ExitCode::kIo, fmt::format("{}: cannot be made a link to {} ({}); check the folder", latest.string(),
                                           run, std::strerror(error)));
}

}  // namespace godobject::firmware
