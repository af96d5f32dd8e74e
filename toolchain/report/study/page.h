#pragma once

#include <string>
#include <vector>

#include "toolchain/report/study/case.h"

namespace godobject::report {

struct PageChapter {
  const Chapter* chapter = nullptr;
  Section section;
  std::vector<std::string> pictures;  ///< bytes of the PNG files, in the order of `section.pictures`
  double seconds = 0.0;               ///< that its cases have taken
};

struct PageContent {
  std::vector<std::string> made_by;  ///< sentences: program, machines, what was run
  std::vector<PageChapter> chapters;
};

/// All chapters in one HTML page that needs no other file: verdicts first, pictures inline.
std::string page(const PageContent& content);

/// RFC 4648.
std::string base64(const std::string& bytes);

}  // namespace godobject::report
