#pragma once

#include <string>
#include <vector>

#include "toolchain/report/study/case.h"

namespace godobject::report {

struct PageChapter {
  const Chapter* chapter = nullptr;
  Section section;
  std::vector<std::string> pictures;  ///< bytes of the PNG files, in the order of `section.pictures`
  double seconds = 0.0;               ///< duration of its cases
};

struct PageContent {
  std::vector<std::string> made_by;  ///< sentences on program, machines and runs
  std::vector<PageChapter> chapters;
};

/// Returns all chapters as one HTML page without other files: verdicts first, pictures inline.
std::string page(const PageContent& content);

/// Returns the bytes in base64 (RFC 4648).
std::string base64(const std::string& bytes);

}  // namespace godobject::report
