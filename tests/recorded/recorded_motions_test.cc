#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/recorded/recorded_motion.h"
#include "tests/support/folder_test.h"

namespace godobject::test {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

/// The records by session, and the header.
std::map<std::string, std::vector<std::string>> records() {
  std::map<std::string, std::vector<std::string>> records;
  std::ifstream in(GODOBJECT_RECORDS);
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> words = words_of(line);
    records[words.front()] = words;
  }
  return records;
}

/// The sessions of a test: as many as run in a tenth of a second.
constexpr std::size_t kTogether = 8;

class RecordedMotions : public FolderTest, public testing::WithParamInterface<std::size_t> {};

/// Nobody changes what a hand feels, or what a cycle costs, without noticing.
TEST_P(RecordedMotions, AreAsTheyWere) {
  constexpr double kRounding = 1e-6;  // of the terms' sizes: what compilers and processors round differently
  const auto known = records();
  const std::vector<std::string> header = words_of(record_header());
  ASSERT_EQ(known.count("session"), 1U);
  ASSERT_EQ(known.at("session"), header);
  const std::vector<RecordedSession> sessions = recorded_sessions();
  for (std::size_t i = GetParam(); i < std::min(sessions.size(), GetParam() + kTogether); ++i) {
    const auto found = known.find(sessions[i].name);
    ASSERT_NE(found, known.end()) << sessions[i].name;
    const std::vector<std::string> now = words_of(record_line(found->first, run_recorded(sessions[i].setup, folder_)));
    ASSERT_EQ(found->second.size(), now.size());
    for (std::size_t k = 1; k < now.size(); ++k) {
      const double was = std::strtod(found->second[k].c_str(), nullptr);
      const double is = std::strtod(now[k].c_str(), nullptr);
      const bool is_sum = k < 1 + 2 * RecordedMotion::kSums;
      const bool is_size = is_sum && k % 2 == 0;
      const double size = is_sum ? std::strtod(now[is_size ? k : k + 1].c_str(), nullptr) : 0.0;
      ASSERT_NEAR(is, was, is_size ? 0.01 * size : kRounding * size + 1e-9)
          << sessions[i].name << ": " << header[k]
          << "; meant? then renew the records as tests/recorded/README.md says";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sessions, RecordedMotions,
                         testing::Range<std::size_t>(0, recorded_sessions().size(), kTogether));

TEST(RecordedMotion, EachSessionHasARecord) {
  EXPECT_EQ(records().size(), recorded_sessions().size() + 1) << "a line for each session, and the header";
}

}  // namespace
}  // namespace godobject::test
