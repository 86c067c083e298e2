// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "corpus/atomic_file.h"
#include "corpus/input_error.h"
#include "corpus/input_file.h"
#include "corpus/json_text.h"
#include "corpus/output_error.h"
#include "corpus/store/store_lock.h"
#include "corpus/whole_folder.h"
#include "tests/scratch.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;
using testing::Scratch;

void Put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

// ---- Files -----------------------------------------------------------------------------------

TEST_CASE("atomic file: the new text takes the old one's place, with its mode, and nothing stays beside it") {
  const Scratch scratch;
  const fs::path file = scratch / "file";
  WriteText(file, "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  WriteText(file, "new");
  CHECK(ReadText(file) == "new");
  CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(scratch.Entries() == 1);
}

TEST_CASE("atomic file: who has the old file open goes on reading it") {
  const Scratch scratch;
  WriteText(scratch / "file", "old");
  std::ifstream reader(scratch / "file");
  WriteText(scratch / "file", "new");
  std::string text;
  CHECK((reader >> text && text == "old"));
}

TEST_CASE("atomic file: a link stays, and the file it leads to is replaced") {
  const Scratch scratch;
  Put(scratch / "there/file", "old");
  fs::create_symlink("there/file", scratch / "link");
  WriteText(scratch / "link", "new");
  CHECK(fs::is_symlink(scratch / "link"));
  CHECK(ReadText(scratch / "there/file") == "new");
}

TEST_CASE("atomic file: a path that can name no file is an input error, a full device an output error") {
  const Scratch scratch;
  CHECK_THROWS_AS(WriteText(scratch / "no/file", "x"), InputError);
  CHECK_THROWS_AS(WriteText(scratch / "", "x"), InputError);
  CHECK_THROWS_AS(WriteText("/dev/full", "x"), OutputError);
  CHECK_THROWS_WITH(WriteText("/dev/full", "x"), Contains("/dev/full: cannot be written"));
  CHECK(scratch.Entries() == 0);
}

TEST_CASE("input file: folders, named pipes and devices are refused, and never waited for") {
  const Scratch scratch;
  REQUIRE(mkfifo((scratch / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(ReadText(scratch / "pipe"), Contains("pipe: found nothing to read (a named pipe)"));
  CHECK_THROWS_WITH(ReadText(scratch / ""), Contains("a directory"));
  CHECK_THROWS_WITH(ReadText("/dev/zero"), Contains("/dev/zero: found nothing to read (a device)"));
}

TEST_CASE("input file: what is larger than the bound is refused, in a file before it is read") {
  const Scratch scratch;
  Put(scratch / "file", "12345");
  CHECK(ReadInput(scratch / "file", 5) == "12345");
  CHECK_THROWS_WITH(ReadInput(scratch / "file", 4), Contains("more than 4 bytes"));
  fs::resize_file(scratch / "file", kMostInputBytes + 1);
  CHECK_THROWS_WITH(ReadText(scratch / "file"), Contains("file: found nothing to read (more than"));
}

TEST_CASE("input file: a pipe that a process has open is read up to the bound") {
  for (const std::size_t most : {5, 4}) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    REQUIRE(write(ends[1], "12345", 5) == 5);
    close(ends[1]);
    const fs::path name = "/dev/fd/" + std::to_string(ends[0]);
    if (most == 5) {
      CHECK(ReadInput(name, most) == "12345");
    } else {
      CHECK_THROWS_WITH(ReadInput(name, most), Contains("more than 4 bytes"));
    }
    close(ends[0]);
  }
}

// ---- Folders ---------------------------------------------------------------------------------

void WriteFolder(const fs::path& target, const std::string& text, const std::string& writer = "report",
                 Occupied occupied = Occupied::kRefused) {
  WholeFolder folder(target, writer, occupied);
  folder.Write("a/" + text, text);
  folder.Commit();
}

TEST_CASE("whole folder: what its writer wrote before is replaced, and nothing of it stays") {
  const Scratch scratch;
  WriteFolder(scratch / "out", "first");
  WriteFolder(scratch / "out", "second");
  CHECK_FALSE(fs::exists(scratch / "out/a/first"));
  CHECK(ReadText(scratch / "out/a/second") == "second");
  CHECK(scratch.Entries() == 1);
}

TEST_CASE("whole folder: until it is committed the old one stands, and then nothing is left of it") {
  const Scratch scratch;
  WriteFolder(scratch / "out", "old");
  {
    WholeFolder folder(scratch / "out", "report", Occupied::kRefused);
    folder.Write("a/new", "new");
    CHECK(ReadText(scratch / "out/a/old") == "old");
    CHECK(ReadText(folder.Place(scratch / "out/a/new")) == "new");
    CHECK(folder.Place(scratch / "outside") == scratch / "outside");
    CHECK_THROWS_WITH(WholeFolder(scratch / "out", "report", Occupied::kRefused), Contains("another process"));
  }
  CHECK(ReadText(scratch / "out/a/old") == "old");
  CHECK(scratch.Entries() == 1);
}

TEST_CASE("whole folder: what others wrote is refused by name, or kept under another one") {
  const Scratch scratch;
  WriteFolder(scratch / "out", "old");
  Put(scratch / "out/a/mine", "mine");
  CHECK_THROWS_WITH(WriteFolder(scratch / "out", "new"),
                    Contains("found 'a/mine', which 'report' did not write"));
  WriteFolder(scratch / "out", "new", "report", Occupied::kSetAside);
  CHECK(ReadText(scratch / "out.old/a/mine") == "mine");
  CHECK_FALSE(fs::exists(scratch / "out/a/old"));
  Put(scratch / "out/b/mine", "mine");
  WriteFolder(scratch / "out", "newer", "report", Occupied::kSetAside);
  CHECK(ReadText(scratch / "out.old2/b/mine") == "mine");
  CHECK(scratch.Entries() == 3);
}

TEST_CASE("whole folder: a file, another verb's folder and the current folder are refused") {
  const Scratch scratch;
  Put(scratch / "file", "x");
  CHECK_THROWS_AS(WriteFolder(scratch / "file", "new"), InputError);
  WriteFolder(scratch / "out", "old", "simulate");
  CHECK_THROWS_WITH(WriteFolder(scratch / "out", "new"), Contains("did not write"));
  CHECK_THROWS_WITH(WriteFolder(".", "new"), Contains("the current folder"));
  CHECK_THROWS_WITH(WriteFolder("/", "new"), Contains("the current folder"));
}

TEST_CASE("whole folder: what appears in the target while it is written is kept") {
  const Scratch scratch;
  WholeFolder folder(scratch / "out", "report", Occupied::kRefused);
  Put(scratch / "out/mine", "mine");
  CHECK(folder.Commit() == scratch / "out.old");
  CHECK(ReadText(scratch / "out.old/mine") == "mine");
}

TEST_CASE("whole folder: the rest of a killed process is removed") {
  const Scratch scratch;
  Put(scratch / ".out.stiction/torn", "x");
  Put(scratch / ".out.stiction/.stiction-files", "simulate\n");
  WriteFolder(scratch / "out", "new");
  CHECK_FALSE(fs::exists(scratch / "out/torn"));
  CHECK(scratch.Entries() == 1);
}

TEST_CASE(
    "whole folder: what stands at the name of the unfinished one and is not of a stopped run is left alone") {
  const Scratch scratch;
  const fs::path unfinished = scratch / ".out.stiction";
  const auto refused = Contains(".out.stiction: found what no stopped run");
  Put(scratch / "theirs/file", "x");
  fs::create_symlink("theirs", unfinished);
  CHECK_THROWS_WITH(WriteFolder(scratch / "out", "new"), refused);
  fs::remove(unfinished);
  Put(unfinished / "file", "x");
  CHECK_THROWS_WITH(WriteFolder(scratch / "out", "new"), refused);
  fs::create_symlink("file", unfinished / ".stiction-files");
  CHECK_THROWS_WITH(WriteFolder(scratch / "out", "new"), refused);
  CHECK(ReadText(unfinished / "file") == "x");
  CHECK(ReadText(scratch / "theirs/file") == "x");
}

TEST_CASE("whole folder: a file is written once, and through no link") {
  const Scratch scratch;
  Put(scratch / "theirs", "x");
  WholeFolder folder(scratch / "out", "report", Occupied::kRefused);
  fs::create_symlink(scratch / "theirs", folder.Place(scratch / "out/file"));
  CHECK_THROWS_AS(folder.Write("file", "y"), OutputError);
  CHECK(ReadText(scratch / "theirs") == "x");
}

// ---- The lock of a store ---------------------------------------------------------------------

TEST_CASE("store lock: a second process on a shard is refused and told who holds it") {
  const Scratch scratch;
  const StoreLock first(scratch / "s", {1, 4});
  CHECK_THROWS_WITH(StoreLock(scratch / "s", {1, 4}),
                    Contains("s: shard 1/4: found process " + std::to_string(getpid()) + " on ") &&
                        Contains(" since 2") && Contains("at work on shard 1/4"));
}

TEST_CASE("store lock: shards that share units exclude each other, others do not") {
  const Scratch scratch;
  const StoreLock first(scratch / "s", {1, 4});
  const StoreLock second(scratch / "s", {3, 4});
  const StoreLock third(scratch / "s", {0, 6});  // of even units, where the others' are odd
  const StoreLock fourth(scratch / "s", {4, 6});
  CHECK_THROWS_AS(StoreLock(scratch / "s", {0, 1}), InputError);
  CHECK_THROWS_AS(StoreLock(scratch / "s", {1, 2}), InputError);
  CHECK_THROWS_AS(StoreLock(scratch / "s", {2, 3}), InputError);
  CHECK_THROWS_AS(StoreLock(scratch / "s", {0, 4}), InputError);  // 12 is of 0/6 too
}

TEST_CASE("store lock: whoever goes makes room, and the last one removes the file") {
  const Scratch scratch;
  auto first = std::make_unique<StoreLock>(scratch / "s", Shard{0, 2});
  auto second = std::make_unique<StoreLock>(scratch / "s", Shard{1, 2});
  first.reset();
  CHECK(fs::exists(scratch / "s.lock"));
  CHECK_THROWS_AS(StoreLock(scratch / "s", {0, 1}), InputError);
  first = std::make_unique<StoreLock>(scratch / "s", Shard{0, 2});
  second.reset();
  first.reset();
  CHECK(scratch.Entries() == 0);
}

TEST_CASE("store lock: a file that a killed process left holds nobody") {
  const Scratch scratch;
  Put(scratch / "s.lock", std::string(256, '\0') + "0/1 process 1 on here since long ago");
  const StoreLock lock(scratch / "s", Shard{});
  CHECK_THROWS_AS(StoreLock(scratch / "s", Shard{}), InputError);
}

TEST_CASE("store lock: a link, a second name and a file of others are refused, and are nobody's lock") {
  const Scratch scratch;
  Put(scratch / "theirs", std::string(300, '\0'));
  Put(scratch / "text", "mine");
  const auto refused = [&scratch](const std::string& store) {
    CHECK_THROWS_WITH(StoreLock(scratch / store, Shard{}),
                      Contains(store + ".lock: found a link or another file"));
    CHECK_FALSE(StoreLock::IsHeld(scratch / store));
  };
  fs::create_symlink("theirs", scratch / "a.lock");
  refused("a");
  fs::create_hard_link(scratch / "theirs", scratch / "b.lock");
  refused("b");
  fs::rename(scratch / "text", scratch / "c.lock");
  refused("c");
  CHECK(ReadText(scratch / "theirs") == std::string(300, '\0'));
  CHECK(ReadText(scratch / "c.lock") == "mine");
}

}  // namespace
}  // namespace stiction
