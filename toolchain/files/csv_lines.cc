#include "toolchain/files/csv_lines.h"

#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

bool read_number(std::string_view word, double& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

CsvLines::CsvLines(const std::filesystem::path& file, std::size_t most)
    : file_(file), line_(kLongest + 1), most_(most) {
  require_input(file);
  stream_.open(file);
}

bool CsvLines::next(std::string_view& content) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  while (stream_.getline(line_.data(), static_cast<std::streamsize>(line_.size())) || stream_.gcount() > 0) {
    ++number_;
    if (number_ > most_)
      refuse(fmt::format("more than {} lines are not read; split the file, or end the pipe earlier", most_));
    // the count includes the end of the line, which the last line may lack
    const auto read = static_cast<std::size_t>(stream_.gcount());
    if (stream_.bad()) break;
    if (stream_.fail()) {
      refuse(
          fmt::format("the line is longer than {} bytes; check that this is the CSV file, and end each row with a "
                      "line break",
                      kLongest));
    }
    bytes_ += read;
    content = std::string_view(line_.data(), stream_.eof() ? read : read - 1);
    if (number_ == 1 && content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
    content = trimmed(content);
    if (!content.empty() && content.front() != '#') return true;
  }
  if (stream_.bad()) {
    throw Failure(ExitCode::kIo, fmt::format("{}: cannot be read to its end; check the disk", file_.string()));
  }
  return false;
}

void CsvLines::refuse(std::string_view what) const {
  throw Failure(ExitCode::kBadData, fmt::format("{}:{}: {}", file_.string(), number_, what));
}

}  // namespace godobject::files
