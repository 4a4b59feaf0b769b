// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "leafhull/error.h"
#include "watercolour/style.h"

namespace leafhull::watercolour {
namespace {

/// The error that a style file causes, with its remedy.
std::string fault(const std::string& json) {
  try {
    parse_style(json, "my.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    return std::string(error.what()) + " | " + error.remedy();
  }
  return "none";
}

std::string number(double value) {
  std::string text = std::to_string(value);
  return text;
}

TEST(Style, AFileChangesWhatItNamesAndNothingElse) {
  const Style classic = shipped_style("classic");
  const Style style = parse_style(
      R"({"seed": 7, "bleeding": 0.25, "paper": "#ff8000", "shadow": {"wetness": 0.75}})",
      "a.json");
  EXPECT_EQ(style.seed, 7u);
  EXPECT_FLOAT_EQ(style.bleeding, 0.25f);
  EXPECT_EQ(style.paper, (Vec3f{1, 128 / 255.0f, 0}));
  EXPECT_FLOAT_EQ(style.shadow.wetness, 0.75f);
  EXPECT_EQ(style.shadow.cool, classic.shadow.cool);
  EXPECT_EQ(style.tone.wetness, classic.tone.wetness);
  EXPECT_EQ(style.turbulence, classic.turbulence);
}

TEST(Style, ABaseIsWhatTheRestComesFrom) {
  const Style style = parse_style(R"({"base": "wet", "detail": 1})", "a.json");
  EXPECT_EQ(style.bleeding, shipped_style("wet").bleeding);
  EXPECT_FLOAT_EQ(style.detail, 1);
  EXPECT_NE(shipped_style("wet").bleeding, shipped_style("classic").bleeding);
  EXPECT_EQ(fault(R"({"base": "oil"})"),
            "my.json: the key 'base' is \"oil\", which names no style | "
            "There are: classic, wet, dry.");
}

TEST(Style, AFaultNamesFileAndKey) {
  EXPECT_EQ(fault("{}"), "none");
  EXPECT_NE(fault("{").find("my.json: not JSON"), std::string::npos);
  EXPECT_NE(fault("[1]").find("my.json: not a JSON object"), std::string::npos);
  EXPECT_NE(fault(R"({"wetnes": 1})").find("my.json: there is no key 'wetnes'"), std::string::npos);
  EXPECT_NE(fault(R"({"tone": {"wetnes": 1}})").find("my.json: there is no key 'tone.wetnes'"),
            std::string::npos);
  EXPECT_NE(fault(R"({"tone": 1})").find("my.json: the key 'tone' is 1, which is not a wash"),
            std::string::npos);
  EXPECT_NE(fault(R"({"seed": 1.5})").find("my.json: the key 'seed' is 1.5, not a whole number"),
            std::string::npos);
  for (const char* color : {"\"green\"", "\"#12345\"", "\"#12345g\"", "\"#+12345\"", "3", "null"}) {
    EXPECT_NE(fault(std::string(R"({"paper": )") + color + "}").find("the key 'paper'"),
              std::string::npos)
        << color;
  }
}

TEST(Style, ANumberThatNoDoubleHoldsIsCalledSo) {
  EXPECT_EQ(fault(R"({"sky": 1e999})"),
            "my.json: a number is too large: '1e999' | Give a number in the range of its key.");
}

TEST(Style, AFaultIsOneLine) {
  const std::string message = fault(R"({"a\nb\u007f": 1})");
  EXPECT_NE(message.find("there is no key 'a b '"), std::string::npos) << message;
  const std::string in_wash = fault(R"({"tone": {"a\nb": 1}})");
  EXPECT_NE(in_wash.find("there is no key 'tone.a b'"), std::string::npos) << in_wash;
  EXPECT_LT(fault("{\"" + std::string(100000, 'x') + "\": 1}").size(), 2000u);
  EXPECT_LT(fault("{\"sky\": \"" + std::string(100000, 'x') + "\"}").size(), 2000u);
}

TEST(Style, EveryNumberHasItsRange) {
  int numbers = 0;
  const auto check = [&](const StyleKey& key, const std::string& before, const std::string& after) {
    if (key.high == key.low) return;  // the key is a colour
    ++numbers;
    const std::string name = "\"" + std::string(key.name) + "\": ";
    const auto with = [&](const std::string& value) { return before + name + value + after; };
    EXPECT_EQ(fault(with(number(key.high))), "none") << key.name;
    for (const std::string& wrong : {number(key.high + 1.0), number(key.low - 1.0)}) {
      EXPECT_NE(fault(with(wrong)).find(std::string(key.name) + "' is out of range: "),
                std::string::npos)
          << key.name << " " << wrong;
      EXPECT_NE(fault(with(wrong)).find("It is a number in " + std::string(key.range)),
                std::string::npos);
    }
    EXPECT_NE(fault(with("\"1\"")).find("which is not a number"), std::string::npos);
    EXPECT_NE(fault(with("true")).find("which is not a number"), std::string::npos);
  };
  for (const StyleKey& key : style_keys()) check(key, "{", "}");
  for (const StyleKey& key : wash_keys()) check(key, R"({"ground": {)", "}}");
  EXPECT_GT(numbers, 25);
}

TEST(Style, TheTableTellsEveryKeyItsRangeAndItsDefault) {
  const std::string table = style_table();
  for (const char* row : {"| `seed` | [0, 1000000] | 1 | ", "| `paper` | a colour | #fdfbf4 | ",
                          "| `bleeding` | [0, 1] | 0.35 | ", "| `shadow.level` | [0, 1] | 0.75 | ",
                          "| `ground.cool` | a colour | #b9c3d4 | "}) {
    EXPECT_NE(table.find(row), std::string::npos) << row;
  }
  const auto rows = std::count(table.begin(), table.end(), '\n') - 2;
  EXPECT_EQ(rows, style_keys().size() + wash_names().size() * wash_keys().size());
}

TEST(Style, ThereAreThreeAndTheyDiffer) {
  ASSERT_EQ(style_names().size(), 3u);
  for (const std::string_view name : style_names()) EXPECT_GT(shipped_style(name).grain, 0) << name;
  EXPECT_NE(shipped_style("classic").tone.cool, shipped_style("wet").tone.cool);
  EXPECT_NE(shipped_style("classic").tone.cool, shipped_style("dry").tone.cool);
  EXPECT_THROW(shipped_style("oil"), Error);
}

}  // namespace
}  // namespace leafhull::watercolour
