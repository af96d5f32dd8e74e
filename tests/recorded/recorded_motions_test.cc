#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/recorded/recorded_motion.h"
#include "tests/support/folder_test.h"

namespace godobject::test {
namespace {

/// The lines of the file by their first column.
std::map<std::string, std::string> records() {
  std::map<std::string, std::string> records;
  std::ifstream in(GODOBJECT_RECORDS);
  for (std::string line; std::getline(in, line);) records[line.substr(0, line.find(','))] = line;
  return records;
}

/// The sessions of a test; those of one compiled world are together.
constexpr std::size_t kTogether = 8;

class RecordedMotions : public FolderTest, public testing::WithParamInterface<std::size_t> {};

/// The records are those of processors whose look-ups have eight lanes or more. Others prove fewer chords free, cut
/// more motions, and rest elsewhere.
bool has_lanes_of_records() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

/// Nobody changes what a hand feels, or what a cycle costs, without noticing.
TEST_P(RecordedMotions, AreAsTheyWere) {
  if (!has_lanes_of_records()) GTEST_SKIP() << "recorded on x86-64 with AVX2";
  const auto known = records();
  const std::vector<RecordedSession> sessions = recorded_sessions();
  RecordedWorlds worlds(folder_);
  for (std::size_t i = GetParam(); i < std::min(sessions.size(), GetParam() + kTogether); ++i) {
    const auto found = known.find(sessions[i].name);
    if (found == known.end()) continue;
    const std::string now = record_line(found->first, worlds.run(sessions[i].setup));
    EXPECT_EQ(difference(found->second, now), "")
        << sessions[i].name << "; is it meant? Then renew the records as tests/recorded/README.md says";
  }
}

INSTANTIATE_TEST_SUITE_P(Sessions, RecordedMotions,
                         testing::Range<std::size_t>(0, recorded_sessions().size(), kTogether));

TEST(RecordedMotion, NearlyEachSessionHasARecord) {
  auto known = records();
  EXPECT_EQ(known.at("session"), record_header());
  known.erase("session");
  std::size_t with_record = 0;
  const std::vector<RecordedSession> sessions = recorded_sessions();
  for (const RecordedSession& session : sessions) with_record += known.count(session.name);
  EXPECT_EQ(with_record, known.size()) << "a record without a session";
  EXPECT_GT(with_record, sessions.size() * 4 / 5);
}

TEST(RecordedMotion, DiffersByAnyCountAndByMoreThanRounding) {
  RecordedMotion motion;
  motion.sum.fill(10.0);
  motion.size.fill(100.0);
  motion.count.fill(3);
  const std::string line = record_line("a", motion);
  EXPECT_EQ(difference(line, line), "");
  for (std::size_t i = 0; i < motion.sum.size(); ++i) {
    RecordedMotion other = motion;
    const double allowed = i == RecordedMotion::kWork ? 1e-2 : 1e-4;
    other.sum[i] += 0.5 * allowed;
    EXPECT_EQ(difference(line, record_line("a", other)), "");
    other.sum[i] += allowed;
    EXPECT_NE(difference(line, record_line("a", other)), "");
  }
  for (std::size_t i = 0; i < motion.count.size(); ++i) {
    RecordedMotion other = motion;
    ++other.count[i];
    EXPECT_NE(difference(line, record_line("a", other)), "");
  }
  EXPECT_NE(difference(line, line + ",1"), "");
  RecordedMotion other = motion;
  other.sum[RecordedMotion::kWork] = 0.0;
  EXPECT_EQ(difference(without_work(line), record_line("a", other)), "");
  ++other.count[0];
  EXPECT_NE(difference(without_work(line), record_line("a", other)), "") << "all other columns count";
}

}  // namespace
}  // namespace godobject::test
