#include "toolchain/files/toml_file.h"

#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/folder_test.h"
#include "tests/support/random.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/toml_nesting.h"

namespace godobject::files {
namespace {

using command::ExitCode;
using command::Failure;

std::string repeated(std::string_view piece, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += piece;
  return text;
}

/// Returns the message with which `text` is refused; empty if it is accepted.
std::string refusal(const std::string& text) {
  try {
    parse_toml(text, "a.toml");
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kBadConfig) << failure.what();
    return failure.what();
  }
  return "";
}

/// Valid TOML that nests `depth` deep, in random ways, with strings and comments that look like more.
class RandomNesting {
 public:
  explicit RandomNesting(test::Random& random) : random_(random) {}

  std::string text(int depth) {
    std::string text = "before = [\"[[[[\", '{{{{', '''\n[a.b.c]\n{''', \"\"\"\\\"\"\"\\\"[ \"\"\"\"] # [[[.{{{\n";
    const int header = random_.integer(0, depth);
    if (header > 0) text += random_.integer(0, 1) == 0 ? "[" + key(header) + "]\n" : "[[" + key(header) + "]]\n";
    return text + pair(depth - header) + "\nafter = 1.5 # .....\n";
  }

 private:
  std::string key(int parts) {
    std::string key;
    for (int i = 0; i < parts; ++i) {
      const char* const part[] = {"a", "\"b.c\"", "'[d]'", "e-1"};
      key += (i == 0 ? "" : random_.integer(0, 1) == 0 ? "." : " . ") + std::string(part[random_.integer(0, 3)]);
    }
    return key;
  }

  /// A key and its value, together `depth` deep.
  std::string pair(int depth) {
    const int dots = random_.integer(0, depth);
    return key(dots + 1) + " = " + value(depth - dots);
  }

  std::string value(int depth) {
    if (depth == 0) return "-1.25";
    if (random_.integer(0, 1) == 0) return "{ first = 1.5, " + pair_apart(depth - 1) + ", last = \"{\" }";
    return "[ 0.5, # [\n " + value(depth - 1) + ", {x.y = 2.5}]";
  }

  /// A pair whose key does not begin as other keys do.
  std::string pair_apart(int depth) {
    const int dots = random_.integer(0, depth);
    return "z" + (dots == 0 ? "" : "." + key(dots)) + " = " + value(depth - dots);
  }

  test::Random& random_;
};

TEST(TomlNesting, IsReadToItsLimitAndRefusedBeyond) {
  test::Random random(8);
  RandomNesting nesting(random);
  const int most = static_cast<int>(kMostNested);
  for (int i = 0; i < 2000; ++i) {
    const int depth = random.integer(0, 2 * most);
    const std::string text = nesting.text(depth);
    // a table in an array is two deep in addition
    const std::string refused = refusal(text);
    if (depth <= most - 3) {
      EXPECT_EQ(refused, "") << text;
    } else if (depth > most) {
      EXPECT_NE(refused.find("nest deeper than 32 levels"), std::string::npos) << refused << "\n" << text;
    }
  }
}

TEST(TomlNesting, CannotEndTheProgramHoweverDeep) {
  constexpr std::size_t kDeep = 200'000;
  const std::string dots = "a" + repeated(".a", kDeep);
  for (const std::string& text :
       {dots + " = 1\n", "[" + dots + "]\n", "[[" + dots + "]]\n", "\xef\xbb\xbf[" + dots + "]\n",
        "x = " + repeated("[", kDeep) + repeated("]", kDeep) + "\n", "x = " + repeated("[", kDeep),
        "x = " + repeated("{a=", kDeep) + "1" + repeated("}", kDeep) + "\n",
        "x = " + repeated("{a.a.a.a=[", kDeep) + repeated("]}", kDeep) + "\n", "x = {y = 1, " + dots + " = 2}\n",
        "x = {y = \"\"\"z\"\"\"\"\", " + dots + " = 2}\n",
        "x = [\n" + repeated("[\n", kDeep) + repeated("]", kDeep + 1), "x = {'''[''' = 1, " + dots + " = 2}\n"}) {
    EXPECT_NE(refusal("# first\n" + text), "") << text.substr(0, 60);
  }
}

TEST(TomlNesting, IsRefusedWithItsLineAndCure) {
  EXPECT_EQ(refusal("a = 1\n\nb = '''\n'''\na" + repeated(".a", 50'000) + " = 1\n"),
            "a.toml:5: tables and arrays nest deeper than 32 levels; write fewer brackets, or fewer dots in the key");
}

class TomlFile : public test::FolderTest {};

TEST_F(TomlFile, IsRefusedWhereItIsEndlessOrTooLong) {
  EXPECT_THROW(parse_toml_file("/dev/zero"), Failure);
  std::ofstream(folder_ / "sparse.toml") << "a = 1\n";
  std::filesystem::resize_file(folder_ / "sparse.toml", std::uintmax_t{1} << 36);
  try {
    parse_toml_file(folder_ / "sparse.toml");
    FAIL() << "read 64 GiB";
  } catch (const Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("is longer than 16777216 bytes; check the path"), std::string::npos)
        << failure.what();
  }
}

}  // namespace
}  // namespace godobject::files
