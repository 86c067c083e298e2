// SPDX-License-Identifier: Apache-2.0
#include "corpus/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "corpus/descriptor.h"
#include "corpus/input_error.h"
#include "corpus/output_error.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

bool IsStandardOutput(const fs::path& file) { return file == "-" || file == "/dev/stdout"; }

// A path that stands for what a process has open: no link to follow, no name to replace.
bool IsDescriptor(const fs::path& file) {
  return file.native().starts_with("/proc/") || file.native().starts_with("/dev/fd/");
}

// Where a link leads.
fs::path Followed(fs::path file) {
  constexpr int kMostLinks = 40;
  std::error_code ignored;
  for (int k = 0; k < kMostLinks && !IsDescriptor(file) && fs::is_symlink(file, ignored); ++k) {
    file = file.parent_path() / fs::read_symlink(file, ignored);
  }
  return file;
}

// Pipes and devices too have no content to keep.
bool IsWrittenDirectly(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return IsDescriptor(file) || (fs::exists(status) && !fs::is_regular_file(status));
}

fs::path FolderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

void WriteTo(int descriptor, std::string_view text, const fs::path& file) {
  if (!WriteAll(descriptor, text)) RefuseOutput(file, errno);
}

// Some file systems have nothing to bring to the disk, and say so.
void Sync(int descriptor, const fs::path& file) {
  if (fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP) RefuseOutput(file, errno);
}

// A file that was not there before: O_EXCL follows no link.
constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;

void WriteOpened(const fs::path& file, int flags, std::string_view text) {
  Descriptor out(open(file.c_str(), flags, 0666));
  if (!out.valid()) RefuseOutput(file, errno);
  WriteTo(out.number(), text, file);
  if (out.Close() != 0) RefuseOutput(file, errno);
}

// A new file beside the target, which takes its place or goes.
class Replacement {
 public:
  explicit Replacement(const fs::path& target) : target_(target) {
    static std::atomic<int> count = 0;
    if (access(target.c_str(), F_OK) == 0 && access(target.c_str(), W_OK) != 0) RefuseOutput(target, errno);
    do {  // what has the name, a link above all, is left alone
      name_ = FolderOf(target) / fmt::format(".stiction-{}-{}", getpid(), ++count);
      out_ = Descriptor(open(name_.c_str(), kNew, 0666));
    } while (!out_.valid() && errno == EEXIST);
    if (!out_.valid()) RefuseOutput(target, errno);
    struct stat old = {};
    if (stat(target.c_str(), &old) == 0) fchmod(out_.number(), old.st_mode & 07777);
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;
  ~Replacement() {
    if (!name_.empty()) unlink(name_.c_str());
  }

  void Write(std::string_view text) { WriteTo(out_.number(), text, target_); }

  void Commit() {
    Sync(out_.number(), target_);
    if (out_.Close() != 0) RefuseOutput(target_, errno);
    if (rename(name_.c_str(), target_.c_str()) != 0) RefuseOutput(target_, errno);
    name_.clear();
    SyncFolder(FolderOf(target_));
  }

 private:
  fs::path target_, name_;
  Descriptor out_;
};

}  // namespace

void RefuseOutput(const fs::path& file, int error) {
  const bool is_path = error == ENOENT || error == ENOTDIR || error == EISDIR || error == ENAMETOOLONG ||
                       error == ELOOP || error == ENXIO;
  const OutputError refused(file.string(), error);
  if (is_path) throw InputError(refused.what());
  throw refused;
}

void SyncFolder(const fs::path& folder) {
  const Descriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.valid()) Sync(opened.number(), folder);  // a folder that may be written but not read: no way
}

void WriteNew(const fs::path& file, std::string_view text) { WriteOpened(file, kNew, text); }

void WriteText(const fs::path& file, std::string_view text) {
  if (IsStandardOutput(file)) {
    std::cout.flush();  // whose text is for people (cli/program.cpp)
    std::fflush(stdout);
    return WriteTo(STDOUT_FILENO, text, "standard output");
  }
  const fs::path target = Followed(file);
  if (IsWrittenDirectly(target)) return WriteOpened(target, O_WRONLY | O_TRUNC | O_CLOEXEC, text);
  Replacement replacement(target);
  replacement.Write(text);
  replacement.Commit();
}

}  // namespace stiction
