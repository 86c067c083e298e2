// SPDX-License-Identifier: Apache-2.0
#include "corpus/whole_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "corpus/atomic_file.h"
#include "corpus/input_error.h"
#include "corpus/json_text.h"
#include "corpus/output_error.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = ".stiction-files";

void MakeFolders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) RefuseOutput(folder, error.value());
}

// Without links, `..` and a slash at the end.
fs::path RealPath(const fs::path& path) {
  std::error_code ignored;
  const fs::path real = fs::weakly_canonical(fs::absolute(path), ignored);
  return real.has_filename() ? real : real.parent_path();
}

bool IsWithin(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// All entries below a folder, by their names in it.
std::vector<fs::path> Entries(const fs::path& folder, bool folders_too) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const bool is_folder = entry.is_directory() && !entry.is_symlink();
    if (folders_too || !is_folder) names.push_back(entry.path().lexically_relative(folder));
  }
  std::sort(names.begin(), names.end());
  return names;
}

// What `writer` wrote into a folder, by its list there: the files and the folders that they are in.
std::set<fs::path> Written(const fs::path& folder, const std::string& writer) {
  std::set<fs::path> written;
  if (!fs::is_regular_file(folder / kList)) return written;
  std::istringstream list(ReadText(folder / kList));
  std::string line;
  if (!std::getline(list, line) || line != writer) return written;
  written.insert(kList);
  while (std::getline(list, line)) {
    for (fs::path name = line; !name.empty(); name = name.parent_path()) written.insert(name);
  }
  return written;
}

// The first entry of a folder that `writer` did not write; nothing if there is none.
fs::path ForeignEntry(const fs::path& folder, const std::string& writer) {
  if (!fs::exists(folder)) return {};
  const std::set<fs::path> written = Written(folder, writer);
  for (const fs::path& name : Entries(folder, true)) {
    if (!written.contains(name)) return name;
  }
  return {};
}

// Of the name itself, not of what a link leads to; empty if there is nothing.
struct stat StatusOf(const fs::path& path) {
  struct stat status = {};
  if (lstat(path.c_str(), &status) != 0) status = {};
  return status;
}

Descriptor OpenFolder(const fs::path& folder) {
  return Descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

// All but the list, by which a folder that was left is known as ours.
void Empty(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != kList) fs::remove_all(entry.path());
  }
}

// The list last: a process may be killed meanwhile.
void Remove(const fs::path& folder) noexcept {
  std::error_code ignored;
  try {
    if (fs::exists(fs::symlink_status(folder))) Empty(folder);
  } catch (const fs::filesystem_error&) {
  }
  fs::remove_all(folder, ignored);
}

// A folder that a stopped run left: of this user, and empty or with the list of what it wrote.
bool IsLeft(const fs::path& folder) {
  const struct stat status = StatusOf(folder);
  return S_ISDIR(status.st_mode) && status.st_uid == geteuid() &&
         (fs::is_empty(folder) || S_ISREG(StatusOf(folder / kList).st_mode));
}

// Where the file system has no locks, nobody holds one.
bool IsLockedByAnother(const Descriptor& folder) {
  return flock(folder.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace

WholeFolder::WholeFolder(const fs::path& target, std::string writer, Occupied occupied)
    : writer_(std::move(writer)), target_(RealPath(target)) {
  RequireReplaceable(occupied);
  building_ = target_.parent_path() / fmt::format(".{}.stiction", target_.filename().string());
  MakeFolders(target_.parent_path());
  LockAndEmpty();
}

WholeFolder::~WholeFolder() {
  if (!committed_) Remove(building_);
}

void WholeFolder::RequireReplaceable(Occupied occupied) const {
  const auto refuse = [this](const std::string& found, const std::string& expected) {
    throw InputError(fmt::format("{}: found {}, expected {}", target_.string(), found, expected));
  };
  if (IsWithin(fs::current_path(), target_))
    refuse("the current folder in it", "a folder that can be replaced");
  if (!fs::exists(target_)) return;
  if (!fs::is_directory(target_)) refuse("no folder", "one, or nothing");
  if (StatusOf(target_).st_dev != StatusOf(target_.parent_path()).st_dev)
    refuse("a mount point", "a folder that can be replaced");
  const fs::path foreign = ForeignEntry(target_, writer_);
  if (foreign.empty() || occupied == Occupied::kSetAside) return;
  refuse(fmt::format("'{}', which '{}' did not write", foreign.string(), writer_),
         "another folder, or --replace, which keeps this one under another name");
}

// Whoever holds the lock of the folder that has the name owns it; a killed process holds none. What somebody
// else put there, a link above all, is left alone.
void WholeFolder::LockAndEmpty() {
  struct stat locked = {};
  bool is_new = false;
  do {
    is_new = mkdir(building_.c_str(), 0777) == 0;
    if (!is_new && errno != EEXIST) RefuseOutput(target_, errno);
    lock_ = OpenFolder(building_);
    if (lock_.valid() && IsLockedByAnother(lock_)) {
      throw InputError(fmt::format("{}: found another process that writes it", target_.string()));
    }
    if (StatusOf(building_).st_ino == 0) continue;  // another process was done with it
    if (!lock_.valid() || (!is_new && !IsLeft(building_))) {
      throw InputError(
          fmt::format("{}: found what no stopped run of this program left, expected nothing of this "
                      "name: move it away, or write another folder than {}",
                      building_.string(), target_.string()));
    }
    fstat(lock_.number(), &locked);
  } while (locked.st_ino == 0 || StatusOf(building_).st_ino != locked.st_ino);
  Empty(building_);
  try {
    WriteList();
  } catch (const OutputError& error) {  // a full disk: nobody else would remove it
    Remove(building_);
    throw OutputError(fmt::format("{}: {}", target_.string(), error.what()));
  }
}

fs::path WholeFolder::Place(const fs::path& path) const {
  const fs::path real = RealPath(path);
  return IsWithin(real, target_) ? building_ / real.lexically_relative(target_) : path;
}

void WholeFolder::Write(const fs::path& name, std::string_view text) const {
  const fs::path file = building_ / name;
  MakeFolders(file.parent_path());
  WriteNew(file, text);
}

fs::path WholeFolder::Commit() {
  WriteList();
  if (syncfs(lock_.number()) != 0) RefuseOutput(target_, errno);
  // Somebody may have put something there meanwhile.
  const fs::path aside = ForeignEntry(target_, writer_).empty() ? fs::path() : SetAside();
  TakePlace();
  return aside;
}

// A list that there is is replaced at once: a process that is killed leaves one.
void WholeFolder::WriteList() const {
  std::string list = writer_ + "\n";
  for (const fs::path& name : Entries(building_, false))
    if (name != kList) list += name.string() + "\n";
  const bool is_first = !fs::exists(fs::symlink_status(building_ / kList));
  const std::string name = is_first ? kList : std::string(kList) + ".new";
  Write(name, list);
  if (!is_first) fs::rename(building_ / name, building_ / kList);
}

fs::path WholeFolder::SetAside() const {
  fs::path aside = target_.string() + ".old";
  for (int k = 2; fs::exists(fs::symlink_status(aside)); ++k)
    aside = fmt::format("{}.old{}", target_.string(), k);
  if (rename(target_.c_str(), aside.c_str()) != 0) RefuseOutput(target_, errno);
  return aside;
}

// The lock of the old folder keeps others from its new name until it is removed.
void WholeFolder::TakePlace() {
  const Descriptor before = OpenFolder(target_);
  if (before.valid()) IsLockedByAnother(before);
  std::string old = building_;
  const bool exchanged =
      before.valid() && renameat2(AT_FDCWD, building_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;
  if (!exchanged) {
    old += "-XXXXXX";
    if (before.valid() && (mkdtemp(old.data()) == nullptr || rename(target_.c_str(), old.c_str()) != 0))
      RefuseOutput(target_, errno);
    if (rename(building_.c_str(), target_.c_str()) != 0) RefuseOutput(target_, errno);
  }
  committed_ = true;
  SyncFolder(target_.parent_path());
  Remove(old);
}

}  // namespace stiction
