// SPDX-License-Identifier: Apache-2.0
#include <sys/wait.h>
#include <unistd.h>

#include "unit/forest_store_test.h"

namespace leafhull::test {
namespace {

class ForestStore : public testing::Test {
 protected:
  std::string opening(bool resume, bool restart = false, const Json& with = plan(),
                      const std::string& writer = "one") {
    return failure_of([&] { const Store store(folder.path(), with, writer, resume, restart); });
  }
  /// Puts the first tiles.
  void fill(std::size_t count, const std::string& writer = "one") {
    Store store(folder.path(), plan(), writer, true, false);
    for (const auto& [id, tile] : tiles) {
      if (count-- == 0) break;
      store.put(tile, record(id));
    }
  }
  void finish_all(const fs::path& single = "all.ply") {
    Store store(folder.path(), plan(), "one", true, false);
    finish(store, tiles, single);
  }

  TemporaryFolder folder;
  Tiles tiles = sample_tiles();
};

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << "no " << word << " in: " << text;
  }
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST_F(ForestStore, TellsWhatIsDone) {
  const auto& [id, tile] = *std::find_if(tiles.begin(), tiles.end(), [](const auto& entry) {
    return !entry.second.mesh.triangles.empty() && !entry.second.lent.empty();
  });
  TileSurface surface = tile;
  surface.leaf_vertices = 7;
  surface.gathered = 8;
  surface.evaluated_voxels = 9;
  surface.dropped_components = 10;
  TileRecord put = record(id);
  put.seconds = 0.25;
  put.resident_bytes = 12;
  put.rank = 3;
  {
    Store store(folder.path(), plan(), "one", false, false);
    put = store.put(surface, put);
    EXPECT_TRUE(store.done().contains(id));
  }
  const Store store(folder.path(), plan(), "other", true, false);
  ASSERT_EQ(store.done().size(), 1u);
  const TileRecord& found = store.done().at(id);
  EXPECT_EQ(found.id(), id);
  EXPECT_EQ(found.vertices, tile.mesh.positions.size());
  EXPECT_EQ(found.triangles, tile.mesh.triangles.size());
  EXPECT_EQ(found.own_vertices, tile.own_vertices);
  EXPECT_EQ(found.bounds.low, put.bounds.low);
  EXPECT_EQ(found.bounds.high, put.bounds.high);
  EXPECT_EQ(found.leaf_vertices, 7u);
  EXPECT_EQ(found.gathered, 8u);
  EXPECT_EQ(found.evaluated_voxels, 9u);
  EXPECT_EQ(found.dropped_components, 10u);
  EXPECT_EQ(found.seconds, 0.25);
  EXPECT_EQ(found.resident_bytes, 12u);
  EXPECT_EQ(found.rank, 3);
  EXPECT_EQ(found.mesh.sha256, put.mesh.sha256);
  EXPECT_EQ(found.mesh.sha256.size(), 64u);
  EXPECT_EQ(found.seam.bytes, put.seam.bytes);
  EXPECT_FALSE(store.finished());
  EXPECT_TRUE(store.warnings().empty());
}

TEST_F(ForestStore, ChecksumsAreSha256) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(record_of("abc").sha256,
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(record_of("abc").bytes, 3u);
  write(folder / "abc", "abc");
  EXPECT_EQ(record_of_file(folder / "abc").sha256, record_of("abc").sha256);
  EXPECT_TRUE(failure_of([&] { record_of_file(folder / "none"); }).starts_with("5 "));
}

TEST_F(ForestStore, IsNotGoneOnWithByAccident) {
  EXPECT_EQ(opening(false), "");
  EXPECT_EQ(opening(false), "");  // no tile is done so far
  fill(3);
  expect_words(opening(false), {"2 ", "unfinished forest: 3 tiles", "--resume", "--restart"});
  EXPECT_EQ(opening(true), "");
}

TEST_F(ForestStore, SaysWhatDiffers) {
  fill(1);
  Json other = plan();
  other["voxel_size"] = 0.5;
  expect_words(opening(true, false, other),
               {"2 ", "voxel_size is 0.25 there and 0.5 here", "--restart"});
  other = plan();
  other["models"][1]["n"] = 4;
  expect_words(opening(true, false, other), {"models.1.n is 3 there and 4 here"});
  other = plan();
  other["models"].push_back(1);
  expect_words(opening(true, false, other), {"models.2 is missing there and 1 here"});
  other = plan();
  other.erase("scene");
  expect_words(opening(true, false, other), {"scene is \"a.csv\" there and missing here"});
  EXPECT_EQ(opening(true), "");
}

TEST_F(ForestStore, TakesNamesThatAreNotUtf8) {
  Json odd = plan();
  odd["scene"] = "\xff.csv";
  EXPECT_EQ(opening(false, false, odd), "");
  EXPECT_EQ(opening(true, false, odd), "");
}

TEST_F(ForestStore, LeavesOtherFoldersAlone) {
  write(folder / "notes.txt", "mine");
  EXPECT_EQ(opening(false), "");
  for (const std::string name :
       {"tiles", "tileset.json", "forest.glb", "work/a", "work/plan.json", "manifest.json"}) {
    const TemporaryFolder other;
    fs::create_directories((other / name).parent_path());
    write(other / name, "mine");
    const auto before = tree(other.path());
    for (const bool restart : {false, true}) {
      const std::string failure =
          failure_of([&] { const Store store(other.path(), plan(), "one", !restart, restart); });
      expect_words(failure, {(other / name).string()});
      EXPECT_EQ(tree(other.path()), before);
    }
  }
}

TEST_F(ForestStore, RestartRemovesTheForestAlone) {
  for (const bool finished : {false, true}) {
    const TemporaryFolder outside;
    write(folder / "notes.txt", "mine");
    fill(5);
    if (finished) finish_all(outside / "all.ply");
    fs::create_directories(folder / "tiles" / "0");
    write(folder / "tiles" / "0" / "notes.txt", "mine");
    Json other = plan();
    other["voxel_size"] = finished ? 1 : 2;
    EXPECT_EQ(opening(false, true, other), "");
    std::set<std::string> names;
    for (const auto& [name, bytes] : tree(folder.path())) names.insert(name);
    EXPECT_EQ(names, (std::set<std::string>{"notes.txt", "tiles", "tiles/0", "tiles/0/notes.txt",
                                            "work", "work/journal-one.jsonl", "work/plan.json"}));
    EXPECT_TRUE(tree(outside.path()).empty());
    EXPECT_EQ(opening(false, true), "");
  }
}

TEST_F(ForestStore, RestartLeavesASingleFileThatIsAnother) {
  finish_all();
  write(folder / "all.ply", "changed since");
  EXPECT_EQ(opening(false, true), "");
  EXPECT_EQ(content(folder / "all.ply"), "changed since");
}

TEST_F(ForestStore, ARestartThatWasCutOffIsGoneOnWith) {
  finish_all();
  fs::create_directory(folder / "work");
  fs::rename(folder / "manifest.json", folder / "work/removed.json");
  fs::remove(folder / "tileset.json");
  Json other = plan();
  other["voxel_size"] = 1;
  EXPECT_EQ(opening(false, false, other), "");
  EXPECT_FALSE(fs::exists(folder / "tiles"));
  EXPECT_FALSE(fs::exists(folder / "all.ply"));
}

TEST_F(ForestStore, RestartWaitsForWriters) {
  const Store store(folder.path(), plan(), "busy", false, false);
  expect_words(opening(false, true), {"2 ", "journal-busy.jsonl is in use"});
  EXPECT_EQ(opening(true), "");
}

TEST_F(ForestStore, EveryWriterHasAJournal) {
  Store one(folder.path(), plan(), "one", false, false);
  Store two(folder.path(), plan(), "two", true, false);
  const auto first = tiles.begin(), second = std::next(first);
  one.put(first->second, record(first->first));
  two.put(second->second, record(second->first));
  EXPECT_EQ(one.done().size(), 1u);
  one.refresh();
  EXPECT_EQ(one.done().size(), 2u);
  expect_words(opening(true, false, plan(), "two"), {"2 ", "journal-two.jsonl is in use", "two"});
  EXPECT_EQ(opening(true, false, plan(), "three"), "");
  EXPECT_TRUE(opening(true, false, plan(), "../three").starts_with("1 "));
}

TEST_F(ForestStore, ManyMayMakeItAtOnce) {
  for (int round = 0; round < 20; ++round) {
    const TemporaryFolder fresh;
    std::vector<pid_t> children;
    for (int i = 0; i < 8; ++i) {
      children.push_back(::fork());
      if (children.back() != 0) continue;
      const std::string writer = "w" + std::to_string(i);
      const auto failure = failure_of(
          [&] { const Store store(fresh.path() / "deep", plan(), writer, true, false); });
      if (!failure.empty()) std::fprintf(stderr, "%s\n", failure.c_str());
      ::_exit(failure.empty() ? 0 : 1);
    }
    for (const pid_t child : children) {
      int status = 0;
      ::waitpid(child, &status, 0);
      EXPECT_EQ(status, 0);
    }
    const Store store(fresh.path() / "deep", plan(), "last", false, false);
  }
}

TEST_F(ForestStore, AFinishedForestStaysAsItIs) {
  finish_all();
  const auto before = tree(folder.path());
  EXPECT_FALSE(before.contains("work"));
  EXPECT_TRUE(before.contains("manifest.json"));
  expect_words(opening(false), {"2 ", "finished", "--resume", "--restart"});
  const Store store(folder.path(), plan(), "one", true, false);
  EXPECT_TRUE(store.finished());
  EXPECT_EQ(tree(folder.path()), before);
  Json other = plan();
  other["voxel_size"] = 1;
  expect_words(opening(true, false, other), {"2 ", "voxel_size"});
}

TEST_F(ForestStore, ItsManifestListsEveryFile) {
  finish_all();
  const Json manifest = Json::parse(content(folder / "manifest.json"));
  EXPECT_EQ(manifest["schema"], "leafhull-forest/1");
  EXPECT_EQ(manifest["plan"], plan());
  std::set<std::string> listed{"manifest.json", "tiles", "tiles/0"};
  const auto check = [&](const std::string& name, const Json& record) {
    listed.insert(name);
    EXPECT_EQ(record["sha256"], record_of_file(folder / name).sha256);
    EXPECT_EQ(record["bytes"], fs::file_size(folder / name));
  };
  for (const auto& [name, record] : manifest["files"].items()) check(name, record);
  for (const Json& tile : manifest["tiles"]) check(tile["file"].get<std::string>(), tile);
  std::set<std::string> there;
  for (const auto& [name, bytes] : tree(folder.path())) there.insert(name);
  EXPECT_EQ(there, listed);
}

TEST_F(ForestStore, AFinishedForestThatLacksAFileIsRefused) {
  for (const std::string name : {"tileset.json", "tiles"}) {
    finish_all();
    const fs::path file =
        name == "tiles" ? fs::directory_iterator(folder / "tiles" / "0")->path() : folder / name;
    fs::remove(file);
    expect_words(opening(true), {"3 ", file.string(), "--restart"});
    EXPECT_EQ(opening(false, true), "");
  }
}

TEST_F(ForestStore, WorkThatOutlivedItsManifestGoes) {
  fill(4);
  fs::copy(folder / "work", folder / "copy", fs::copy_options::recursive);
  finish_all();
  const auto before = tree(folder.path());
  fs::rename(folder / "copy", folder / "work");
  const Store store(folder.path(), plan(), "one", true, false);
  EXPECT_TRUE(store.finished());
  EXPECT_FALSE(fs::exists(folder / "work"));
}

}  // namespace
}  // namespace leafhull::test
