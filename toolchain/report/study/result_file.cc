#include "toolchain/report/study/result_file.h"

#include <fstream>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <sys/utsname.h>
#include <nlohmann/json.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/atomic_file.h"

namespace godobject::report {
namespace {

using nlohmann::json;

constexpr int kFormat = 2;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

json json_of(const Finding& finding) {
  json all{{"row", finding.row},           {"what", finding.what},   {"unit", finding.unit},
           {"value", cell(finding.value)}, {"where", finding.where}, {"not_judged", finding.not_judged},
           {"timed", finding.timed}};
  if (finding.most) all["most"] = cell(*finding.most);
  return all;
}

Finding finding_of(const json& all) {
  Finding finding{.row = all.at("row"),
                  .what = all.at("what"),
                  .unit = all.at("unit"),
                  .value = number(all.at("value")),
                  .most = {},
                  .where = all.at("where"),
                  .not_judged = all.at("not_judged"),
                  .timed = all.at("timed")};
  if (all.contains("most")) finding.most = number(all.at("most"));
  return finding;
}

}  // namespace

std::string digest(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

std::string file_digest(const std::filesystem::path& file) { return digest(bytes_of(file)); }

const std::string& program_digest() {
  static const std::string found = file_digest("/proc/self/exe");
  return found;
}

const std::string& this_machine() {
  static const std::string found = [] {
    utsname system{};
    ::uname(&system);
    return fmt::format("{} {}, {}, {}, {} processors", system.sysname, system.release, system.machine, processor(),
                       std::thread::hardware_concurrency());
  }();
  return found;
}

std::filesystem::path result_path(const std::filesystem::path& folder, const std::string& name) {
  return folder / (name + ".json");
}

void write_result(const std::filesystem::path& file, const std::string& name, const StoredResult& stored) {
  json all{{"format", kFormat},         {"case", name},
           {"inputs", stored.inputs},   {"program", stored.program},
           {"machine", stored.machine}, {"seconds", stored.seconds},
           {"findings", json::array()}, {"sheets", json::array()}};
  for (const Finding& finding : stored.result.findings) all["findings"].push_back(json_of(finding));
  for (const Sheet& sheet : stored.result.sheets) {
    all["sheets"].push_back({{"name", sheet.name}, {"columns", sheet.columns}, {"rows", sheet.rows}});
  }
  files::AtomicFile out(file);
  out.write(all.dump(1) + "\n");
  out.commit();
}

std::optional<StoredResult> read_result(const std::filesystem::path& file, const std::string& name) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  try {
    const json all = json::parse(bytes_of(file));
    if (all.at("format") != kFormat || all.at("case") != name) throw std::runtime_error("another case or format");
    StoredResult stored{all.at("inputs"), all.at("program"), all.at("machine"), all.at("seconds"), {}};
    for (const json& finding : all.at("findings")) stored.result.findings.push_back(finding_of(finding));
    for (const json& sheet : all.at("sheets")) {
      stored.result.sheets.push_back({sheet.at("name"), sheet.at("columns"), sheet.at("rows")});
    }
    return stored;
  } catch (const std::exception& error) {
    throw command::Failure(command::ExitCode::kBadData, fmt::format("{}: not a result of the case {} ({}); remove it",
                                                                    file.string(), name, error.what()));
  }
}

}  // namespace godobject::report
