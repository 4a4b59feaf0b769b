// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "leafhull/error.h"
#include "runs/sealed_json.h"
#include "sweep/journal.h"
#include "sweep/sweep_plan.h"
#include "unit/temporary_folder.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

Json header() { return {{"schema", kJournalSchema}, {"version", "1"}}; }
Json row(std::size_t i) { return {{"row", i}, {"picture", "p.png"}, {"x", 0.1 * double(i)}}; }

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

class SweepJournal : public testing::Test {
 protected:
  void fill(std::size_t rows) {
    Journal journal(file);
    journal.begin(header());
    for (std::size_t i = 0; i < rows; ++i) journal.append(row(i));
  }

  test::TemporaryFolder folder;
  fs::path file = folder.path() / "sweep.jsonl";
};

TEST_F(SweepJournal, GoesOn) {
  EXPECT_TRUE(Journal(file).header().is_null());
  fill(2);
  {
    Journal journal(file);
    EXPECT_EQ(journal.header(), header());
    journal.append(row(7));
  }
  const Journal journal(file);
  ASSERT_EQ(journal.rows().size(), 3u);
  EXPECT_EQ(journal.rows().at(1), row(1));
  EXPECT_EQ(journal.rows().at(7), row(7));
}

TEST_F(SweepJournal, EveryCutLosesAtMostTheLastLine) {
  fill(3);
  const std::string whole = content(file);
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = last; size < whole.size(); ++size) {
    write(file, whole.substr(0, size));
    Journal journal(file);
    EXPECT_EQ(journal.rows().size(), 2u) << size;
    const Json shorter = {{"row", 2}, {"picture", ""}};
    journal.append(shorter);
    EXPECT_EQ(content(file), whole.substr(0, last) + dumped(sealed(shorter)) + "\n");
  }
}

TEST_F(SweepJournal, ALineThatIsNoRowDoesNotCount) {
  fill(1);
  std::string text = content(file) + std::string(20, '\0') + "\n[1]\n";
  for (const Json& line :
       {Json{{"row", "x"}, {"picture", "p"}}, Json{{"row", -1}, {"picture", "p"}}, Json{{"row", 5}},
        Json{{"row", 5}, {"picture", 1}}}) {
    text += dumped(sealed(line)) + "\n";
  }
  write(file, text);
  EXPECT_EQ(Journal(file).rows().size(), 1u);
}

TEST_F(SweepJournal, ALineThatIsDamagedDoesNotCount) {
  fill(3);
  std::string text = content(file);
  const std::size_t at = text.find("0.1");
  ASSERT_NE(at, std::string::npos);
  text[at + 2] = '7';
  write(file, text);
  const Journal journal(file);
  EXPECT_EQ(journal.rows().size(), 2u);
  EXPECT_FALSE(journal.rows().contains(1));
}

TEST_F(SweepJournal, BeginsAnew) {
  fill(3);
  {
    Journal journal(file);
    journal.begin(header());
    EXPECT_TRUE(journal.rows().empty());
  }
  EXPECT_TRUE(Journal(file).rows().empty());
}

TEST_F(SweepJournal, SaysWhoseItIsThoughItIsDamagedOrOfAnotherVersion) {
  fill(2);
  std::string damaged = content(file);
  damaged[damaged.find("version")] = 'w';
  for (const std::string& text :
       {damaged, std::string("{\"schema\":\"leafhull-sweep-journal/1\",\"version\":\"1\"}\n")}) {
    write(file, text);
    Journal journal(file);
    EXPECT_FALSE(journal.is_readable()) << text;
    EXPECT_EQ(content(file), text);
    journal.begin(header());
    EXPECT_TRUE(journal.is_readable());
  }
}

TEST_F(SweepJournal, AnotherFileIsLeftAlone) {
  for (const char* text : {"notes\n", "{\"schema\":\"other/1\"}\n", "[]\n", "{\"sch"}) {
    write(file, text);
    EXPECT_THROW(Journal{file}, Error) << text;
    EXPECT_EQ(content(file), text);
  }
}

TEST_F(SweepJournal, OneProcessAtATime) {
  const Journal journal(file);
  try {
    Journal second(file);
    FAIL() << "both write";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
  }
}

TEST_F(SweepJournal, AFullDiskLeavesItIntact) {
  fill(2);
  const std::string before = content(file);
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit full{before.size() + 10, limit.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  {
    Journal journal(file);
    setrlimit(RLIMIT_FSIZE, &full);
    EXPECT_THROW(journal.append(row(2)), Error);
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_EQ(content(file), before);
    journal.append(row(2));
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(Journal(file).rows().size(), 3u);
}

}  // namespace
}  // namespace leafhull
