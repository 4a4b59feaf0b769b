// SPDX-License-Identifier: Apache-2.0
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "forest/seam_file.h"
#include "unit/forest_store_test.h"

namespace leafhull::test {
namespace {

using Clock = std::chrono::steady_clock;

class ForestStoreDamage : public testing::Test {
 protected:
  /// A whole run, which puts only the missing tiles.
  void run(const fs::path& at) const {
    Store store(at, plan(), "one", true, false);
    if (!store.finished()) finish(store, tiles, "all.glb");
  }
  /// The files of an undisturbed run.
  std::map<std::string, std::string> undisturbed() const {
    const TemporaryFolder other;
    run(other.path());
    return tree(other.path());
  }
  void fill() const {
    Store store(folder.path(), plan(), "one", true, false);
    for (const auto& [id, tile] : tiles) store.put(tile, record(id));
  }
  std::string opening() const {
    return failure_of([&] { const Store store(folder.path(), plan(), "two", true, false); });
  }

  TemporaryFolder folder;
  Tiles tiles = sample_tiles();
  fs::path journal = folder / "work/journal-one.jsonl";
};

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST_F(ForestStoreDamage, EveryCutIsMadeGood) {
  const auto expected = undisturbed();
  fill();
  std::mt19937 random(1);
  const auto up_to = [&](std::uintmax_t n) {
    return std::uniform_int_distribution<std::uintmax_t>(0, n)(random);
  };
  for (int round = 0; round < 12; ++round) {
    const TemporaryFolder other;
    fs::copy(folder.path(), other.path(), fs::copy_options::recursive);
    for (const fs::path& file : files_below(other / "work")) {
      if (file.filename() == "plan.json" || up_to(9) != 0) continue;
      fs::resize_file(file, up_to(fs::file_size(file)));
    }
    const fs::path cut = other / "work/journal-one.jsonl";
    if (up_to(2) == 0) fs::resize_file(cut, up_to(fs::file_size(cut)));
    run(other.path());
    EXPECT_TRUE(tree(other.path()) == expected) << round;
  }
}

TEST_F(ForestStoreDamage, ATornLineDoesNotCount) {
  fill();
  const std::string whole = content(journal);
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = last; size < whole.size(); size += 17) {
    write(journal, whole.substr(0, size));
    {
      const Store store(folder.path(), plan(), "two", true, false);
      EXPECT_EQ(store.done().size(), tiles.size() - 1);
      EXPECT_EQ(content(journal).size(), size) << "another writer's line was cut off";
    }
    Store store(folder.path(), plan(), "one", true, false);
    store.put(tiles.rbegin()->second, record(tiles.rbegin()->first));
    EXPECT_EQ(content(journal), whole);
  }
}

TEST_F(ForestStoreDamage, ALostFileIsSaid) {
  fill();
  const auto files = files_below(folder / "work/0");
  fs::remove(files[0]);
  fs::resize_file(files[5], 3);
  const Store store(folder.path(), plan(), "two", true, false);
  EXPECT_EQ(store.done().size(), tiles.size() - 2);
  ASSERT_EQ(store.warnings().size(), 1u);
  EXPECT_TRUE(store.warnings()[0].starts_with("2 tiles are computed again")) << store.warnings()[0];
}

TEST_F(ForestStoreDamage, EveryBitOfAJournalCounts) {
  fill();
  const std::string whole = content(journal);
  std::mt19937 random(2);
  for (int round = 0; round < 60; ++round) {
    std::string damaged = whole;
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, whole.size() - 2)(random);
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (round % 7)));
    write(journal, damaged);
    const std::string failure = opening();
    EXPECT_TRUE(failure.starts_with("3 ")) << failure;
    const auto line = 1 + std::count(whole.begin(), whole.begin() + std::ptrdiff_t(at), '\n');
    const std::string where = journal.string() + ", line " + std::to_string(line);
    // A damaged line end makes the line longer, a new one makes it shorter.
    EXPECT_NE(failure.find(where), std::string::npos) << failure;
  }
  write(journal, whole + "notes\n");
  EXPECT_TRUE(opening().starts_with("3 "));
  write(journal, whole + "{\"schema\":\"another/1\",\"sha256\":\"\"}\n");
  EXPECT_NE(opening().find("another/1"), std::string::npos) << opening();
}

TEST_F(ForestStoreDamage, AJournalOfAnotherForestIsRefused) {
  fill();
  const std::string foreign = content(journal);
  const TemporaryFolder other;
  Json another = plan();
  another["voxel_size"] = 1;
  { const Store store(other.path(), another, "one", false, false); }
  write(other / "work/journal-two.jsonl", foreign);
  const std::string failure =
      failure_of([&] { const Store store(other.path(), another, "one", true, false); });
  EXPECT_TRUE(failure.starts_with("2 ")) << failure;
  EXPECT_NE(failure.find("journal-two.jsonl, line 1, belongs to another forest"),
            std::string::npos);
}

TEST_F(ForestStoreDamage, ADamagedPlanOrManifestIsRefused) {
  for (const std::string name : {"work/plan.json", "manifest.json"}) {
    const TemporaryFolder other;
    { const Store store(other.path(), plan(), "one", false, false); }
    if (name == "manifest.json") run(other.path());
    const std::string whole = content(other / name);
    const auto failure_with = [&](const std::string& bytes) {
      write(other / name, bytes);
      return failure_of([&] { const Store store(other.path(), plan(), "one", true, false); });
    };
    std::mt19937 random(3);
    for (int round = 0; round < 100; ++round) {
      std::string damaged = whole;
      std::size_t at = 0;
      do {
        at = std::uniform_int_distribution<std::size_t>(0, whole.size() - 2)(random);
      } while (std::isspace(static_cast<unsigned char>(whole[at])) != 0);
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << (round % 7)));
      const std::string failure = failure_with(damaged);
      EXPECT_TRUE(failure.starts_with("3 ")) << failure << " " << whole[at] << damaged[at];
      EXPECT_NE(failure.find((other / name).string()), std::string::npos) << failure;
    }
    EXPECT_TRUE(failure_with(whole.substr(0, whole.size() / 2)).starts_with("3 "));
    EXPECT_TRUE(failure_with("").starts_with("3 "));
    EXPECT_EQ(failure_with(whole), "");
  }
}

TEST_F(ForestStoreDamage, IsFoundBeforeTilesAreInPlace) {
  fill();
  const auto expected = undisturbed();
  for (const char* extension : {".glb", ".seam"}) {
    const fs::path file =
        folder / (std::string("work/0/0_0_0") + extension);  // this tile drops no pieces
    std::string bytes = content(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    fs::remove(file);
    write(file, bytes);
    Store store(folder.path(), plan(), "two", true, false);
    EXPECT_EQ(store.done().size(), tiles.size());
    const std::string failure =
        failure_of([&] { put_in_place(store, ids_of(tiles), kEdge, small_pieces(), "all.glb"); });
    EXPECT_TRUE(failure.starts_with("3 ")) << failure;
    EXPECT_NE(failure.find(file.string() + " is damaged"), std::string::npos) << failure;
    store.refresh();
    EXPECT_EQ(store.done().size(), tiles.size() - 1);
    EXPECT_EQ(store.warnings().size(), 1u);
    const auto lost = std::find_if(tiles.begin(), tiles.end(), [&](const auto& entry) {
      return !store.done().contains(entry.first);
    });
    store.put(lost->second, record(lost->first));
  }
  run(folder.path());
  EXPECT_TRUE(tree(folder.path()) == expected);
}

TEST_F(ForestStoreDamage, ATileThatIsNotDoneIsAnError) {
  Store store(folder.path(), plan(), "one", true, false);
  EXPECT_TRUE(failure_of([&] {
                put_in_place(store, ids_of(tiles), kEdge, small_pieces(), std::nullopt);
              }).starts_with("1 "));
}

TEST_F(ForestStoreDamage, SeamsAreReadAsTheyWereWritten) {
  Seam seam;
  seam.own_vertices = 4;
  seam.borrowed = {{{-1, 2, -3}, 1, 5, 0}};
  seam.lent = {{{4, 5, 6}, 0, 1, 1}, {{4, 5, 6}, 1, 2, 0}};
  seam.components = {{3, -voxels(1e9)}, {1, ExactVolume{1} << 100}};
  seam.loose.origin = {1, 2, 3};
  seam.loose.positions = {{1, 2, 3}};
  seam.loose.normals = {{0, 1, 0}};
  std::ostringstream stream;
  write_seam(seam, stream);
  const std::string bytes = stream.str();
  const Seam read = read_seam(bytes, "a.seam");
  EXPECT_EQ(read.own_vertices, 4u);
  EXPECT_EQ(read.borrowed, seam.borrowed);
  EXPECT_EQ(read.borrowed[0].vertex, 5u);
  EXPECT_EQ(read.lent, seam.lent);
  EXPECT_EQ(read.lent[0].component, 1u);
  EXPECT_TRUE(read.components[0].volume == -voxels(1e9));
  EXPECT_TRUE(read.components[1].volume == ExactVolume{1} << 100);
  EXPECT_EQ(read.components[1].vertex, 1u);
  EXPECT_EQ(read.loose.origin, seam.loose.origin);
  EXPECT_EQ(read.loose.positions, seam.loose.positions);
  EXPECT_EQ(read.loose.normals, seam.loose.normals);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(read_seam(bytes.substr(0, size), "a.seam"), Error) << size;
  }
  EXPECT_THROW(read_seam(bytes + "x", "a.seam"), Error);
  EXPECT_THROW(read_seam("L" + bytes.substr(1), "a.seam"), Error);
}

TEST_F(ForestStoreDamage, ManyKillsEndWithTheSameBytes) {
  const Clock::time_point begin = Clock::now();
  const auto expected = undisturbed();
  const std::chrono::duration<double> whole = Clock::now() - begin;
  std::mt19937 random(4);
  int kills = 0, runs = 0;
  while (kills < 50) {
    const TemporaryFolder at;
    for (bool ended = false; !ended;) {
      const pid_t child = ::fork();
      ASSERT_GE(child, 0);
      if (child == 0) {
        const std::string failure = failure_of([&] { run(at.path()); });
        if (!failure.empty()) std::fprintf(stderr, "%s\n", failure.c_str());
        ::_exit(failure.empty() ? 0 : 1);
      }
      const double part = std::uniform_real_distribution<double>(0, 1)(random);
      std::this_thread::sleep_for(whole * (part * part));
      ::kill(child, SIGKILL);
      int status = 0;
      ASSERT_EQ(::waitpid(child, &status, 0), child);
      ended = WIFEXITED(status);
      if (ended) {
        EXPECT_EQ(WEXITSTATUS(status), 0);
      } else {
        ++kills;
      }
    }
    ++runs;
    EXPECT_TRUE(tree(at.path()) == expected) << "after " << kills << " kills";
  }
  RecordProperty("kills", kills);
  RecordProperty("runs", runs);
}

// A whole run fails in a process whose files may not exceed `bytes`, and a later run continues it.
TEST_F(ForestStoreDamage, AFullDiskLeavesItToGoOnWith) {
  const auto expected = undisturbed();
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  std::set<std::string> failures;
  for (rlim_t bytes = 100; bytes < 2000000; bytes = bytes * 3 / 2) {
    const rlimit small{bytes, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string failure = failure_of([&] { run(folder.path()); });
    setrlimit(RLIMIT_FSIZE, &limit);
    if (failure.empty()) break;
    EXPECT_TRUE(failure.starts_with("5 ")) << failure;
    EXPECT_NE(failure.find("File too large"), std::string::npos) << failure;
    failures.insert(failure);
    // The folder still opens; at most the two files of the failed tile have no line.
    EXPECT_EQ(opening(), "");
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_GE(failures.size(), 4u);
  run(folder.path());
  EXPECT_TRUE(tree(folder.path()) == expected);
}

TEST_F(ForestStoreDamage, NoSpaceLeftLeavesItToGoOnWith) {
  const auto expected = undisturbed();
  if (::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=160k") != 0) {
    GTEST_SKIP() << "no small file system can be mounted here: a full disk is NOT tested";
  }
  const std::string failure = failure_of([&] { run(folder.path()); });
  EXPECT_TRUE(failure.starts_with("5 ")) << failure;
  EXPECT_NE(failure.find("No space left on device"), std::string::npos) << failure;
  EXPECT_EQ(::mount("tmpfs", folder.path().c_str(), "tmpfs", MS_REMOUNT, "size=64m"), 0);
  run(folder.path());
  const auto found = tree(folder.path());
  EXPECT_EQ(::umount(folder.path().c_str()), 0);
  EXPECT_TRUE(found == expected);
}

}  // namespace
}  // namespace leafhull::test
