// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <set>
#include <stdexcept>

#include "leafhull/error.h"
#include "runs/difference.h"
#include "runs/identity.h"
#include "runs/read_file.h"
#include "runs/run_folder.h"
#include "runs/sealed_json.h"
#include "unit/temporary_folder.h"

namespace leafhull::test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

class RunFolders : public testing::Test {
 protected:
  Names unfinished() const {
    Names names;
    for (const fs::path& entry : entries_of(work)) names.insert(entry.filename().string());
    return names;
  }

  TemporaryFolder place;
  fs::path work = place / "work";
  RunFolder folder{work, "one"};
};

TEST_F(RunFolders, WriteMakesFoldersAndTellsTheChecksum) {
  const fs::path file = place / "deep" / "er" / "a";
  const FileRecord record = folder.write(file, "abc");
  EXPECT_EQ(content_of(file), "abc");
  EXPECT_EQ(record, record_of_file(file));
  EXPECT_EQ(unfinished(), Names{});
}

TEST_F(RunFolders, AFileThatIsReplacedKeepsItsPermissions) {
  folder.write(place / "a", "old");
  fs::permissions(place / "a", fs::perms(0640));
  folder.write(place / "a", "new");
  EXPECT_EQ(content_of(place / "a"), "new");
  EXPECT_EQ(fs::status(place / "a").permissions(), fs::perms(0640));
}

TEST_F(RunFolders, AFailureLeavesTheFormerFile) {
  folder.write(place / "a", "old");
  const auto broken = [](std::ostream& stream) {
    stream << "half" << std::flush;
    throw std::runtime_error("broken");
  };
  EXPECT_THROW(folder.write(place / "a", broken), std::runtime_error);
  const auto refuse = [&](const FileRecord& record) {
    EXPECT_EQ(record, record_of("new"));
    EXPECT_EQ(content_of(place / "a"), "old");
    throw std::runtime_error("refused");
  };
  EXPECT_THROW(folder.write(
                   place / "a", [](std::ostream& stream) { stream << "new"; }, refuse),
               std::runtime_error);
  EXPECT_EQ(content_of(place / "a"), "old");
  EXPECT_EQ(unfinished(), Names{});
}

TEST_F(RunFolders, WriteOnceKeepsTheFirst) {
  folder.write_once(place / "a", "first");
  RunFolder(work, "two").write_once(place / "a", "second");
  EXPECT_EQ(content_of(place / "a"), "first");
  EXPECT_EQ(unfinished(), Names{});
}

TEST_F(RunFolders, LinkReplacesByASecondName) {
  folder.write(place / "a", "abc");
  folder.write(place / "b", "old");
  for (int again = 0; again < 2; ++again) {
    folder.link(place / "a", place / "b");
    EXPECT_TRUE(fs::equivalent(place / "a", place / "b"));
    EXPECT_EQ(unfinished(), Names{});
  }
}

TEST_F(RunFolders, RemovesUnfinishedFilesOfItsOwnNameAlone) {
  fs::create_directory(work);
  for (const char* name : {".one.a.7-0.tmp", ".one.0.tmp", ".two.a.7-0.tmp", ".one.a", "one.tmp"}) {
    std::ofstream(work / name) << "half";
  }
  folder.remove_unfinished();
  EXPECT_EQ(unfinished(), (Names{".two.a.7-0.tmp", ".one.a", "one.tmp"}));
}

TEST(Differences, AreFoundInTheOrderOfHere) {
  const Json here{{"b", 1}, {"a", {{"x", 1}, {"y", {1, 2}}}}};
  const auto path_of = [&](const Json& there) {
    const auto found = first_difference(there, here);
    return found ? found->text() : "none";
  };
  EXPECT_EQ(path_of(here), "none");
  EXPECT_EQ(path_of({{"b", 2}, {"a", 1}}), "b is 2 there and 1 here");
  EXPECT_EQ(path_of({{"b", 1}, {"a", {{"x", 1}, {"y", {1, 3}}}}}), "a.y.1 is 3 there and 2 here");
  EXPECT_EQ(path_of({{"b", 1}, {"a", {{"x", 1}, {"y", {1}}}}}),
            "a.y.1 is missing there and 2 here");
  Json more = here;
  more["c"] = "new";
  EXPECT_EQ(path_of(more), "c is \"new\" there and missing here");
  EXPECT_EQ(path_of(Json::array()).substr(0, 8), "the plan");
}

TEST(SealedJson, EveryChangeBreaksTheSeal) {
  const Json object{{"schema", "a/1"}, {"x", 0.1}, {"name", "\xff"}};
  const std::string text = dumped(sealed(object));
  const std::optional<Json> back = unsealed(text);
  ASSERT_TRUE(back);
  EXPECT_EQ(dumped(*back), dumped(object));
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_FALSE(unsealed(damaged)) << damaged;
    EXPECT_THROW(unsealed(damaged, "a/1", "it", ""), Error) << damaged;
  }
  for (const char* other : {"", "[]", "{}", "1", "{\"sha256\": 1}"}) {
    EXPECT_FALSE(unsealed(other)) << other;
  }
}

TEST(Identity, TellsLeavesApart) {
  LeafSet leaves;
  leaves.vertices = {{{1, 2, 3}, {0, 0, 1}, {1, 0, 0}, 0.5F, 0.25F, 0}};
  const std::string same = checksum_of(leaves);
  std::set<std::string> sums{same};
  const auto add = [&](const auto& change) {
    LeafSet other = leaves;
    change(other.vertices.front());
    EXPECT_TRUE(sums.insert(checksum_of(other)).second);
  };
  add([](LeafVertex& leaf) { leaf.position.z = 4; });
  add([](LeafVertex& leaf) { leaf.normal = {0, 1, 0}; });
  add([](LeafVertex& leaf) { leaf.major = {0, 1, 0}; });
  add([](LeafVertex& leaf) { leaf.radius_major = 0.75F; });
  add([](LeafVertex& leaf) { leaf.radius_minor = 0.125F; });
  EXPECT_EQ(checksum_of(leaves), same);
}

}  // namespace
}  // namespace leafhull::test
