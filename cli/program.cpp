// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <fmt/format.h>
#include <gmp.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <streambuf>
#include <string_view>

#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/keep_memory.h"
#include "corpus/output_error.h"
#include "corpus/plain_text.h"
#include "corpus/program_name.h"

namespace stiction {
namespace {

// What is for people, without the control characters that names out of files may have: they become '?'. JSON
// has none, and files are written past it (corpus/atomic_file.h).
class PlainText : public std::streambuf {
 public:
  explicit PlainText(std::ostream& stream) : stream_(stream), beneath_(stream.rdbuf(this)) {}
  PlainText(const PlainText&) = delete;
  PlainText& operator=(const PlainText&) = delete;
  ~PlainText() override { stream_.rdbuf(beneath_); }

 private:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    return beneath_->sputc(Plain(traits_type::to_char_type(c)));
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    std::string plain(text, static_cast<std::size_t>(size));
    std::ranges::transform(plain, plain.begin(), Plain);
    return beneath_->sputn(plain.data(), size);
  }
  int sync() override { return beneath_->pubsync(); }

  static char Plain(char c) {
    const bool is_control = (0 <= c && c < ' ' && c != '\n' && c != '\t') || c == '\x7f';
    return is_control ? '?' : c;
  }

  std::ostream& stream_;
  std::streambuf* beneath_;
};

// GMP ends a program that has no more memory with abort(), and nothing can be thrown through it.
[[noreturn]] void EndWithoutMemory() {
  constexpr std::string_view kLine = "stiction: limit: out of memory\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kLine.data(), kLine.size());
  _exit(kExitUndecided);
}

void* Allocate(std::size_t size) {
  void* const memory = std::malloc(size);
  return memory != nullptr ? memory : (EndWithoutMemory(), nullptr);
}

void* Reallocate(void* old, std::size_t, std::size_t size) {
  void* const memory = std::realloc(old, size);
  return memory != nullptr ? memory : (EndWithoutMemory(), nullptr);
}

void Free(void* memory, std::size_t) { std::free(memory); }

// What ended the program: in a terminal it fits, elsewhere it is one line.
int Refuse(std::string_view why, int status) {
  const std::string line = fmt::format("stiction: {}\n", AsTyped(std::string(why)));
  std::cerr << (isatty(STDERR_FILENO) ? Folded(line, TextWidth(STDERR_FILENO)) : line);
  return status;
}

}  // namespace

std::string AsTyped(std::string text) {
  const std::string name = ProgramName();
  constexpr std::string_view kName = "stiction", kBefore = " \n'`(";
  std::size_t at = text.find(kName);
  while (at != text.npos) {
    const std::size_t end = at + kName.size();
    const bool begins = at == 0 || kBefore.find(text[at - 1]) != kBefore.npos;
    const bool has_verb =
        end + 1 < text.size() && text[end] == ' ' && 'a' <= text[end + 1] && text[end + 1] <= 'z';
    if (begins && has_verb) text.replace(at, kName.size(), name);
    at = text.find(kName, begins && has_verb ? at + name.size() : end);
  }
  return text;
}

int RunProgram(int argc, char** argv, int (*run)(int argc, char** argv)) {
  KeepFreedMemory();
  mp_set_memory_functions(Allocate, Reallocate, Free);
  const PlainText out(std::cout), errors(std::cerr);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of write
  try {
    const int status = run(argc, argv);
    std::cout.flush();
    if (!std::cout || std::ferror(stdout) != 0 || std::fflush(stdout) != 0) {
      throw OutputError("standard output cannot be written");
    }
    return status;
  } catch (const InputError& error) {
    return Refuse(error.what(), kExitBadInput);
  } catch (
      const std::filesystem::filesystem_error& error) {  // of a path that was given, and cannot be looked at
    return Refuse(fmt::format("{}: {}", error.path1().string(), error.code().message()), kExitBadInput);
  } catch (const OutputError& error) {
    return Refuse(error.what(), kExitDisk);
  } catch (const std::bad_alloc&) {
    return Refuse("limit: out of memory", kExitUndecided);
  } catch (const std::exception& error) {
    return Refuse(fmt::format("internal error: {}", error.what()), kExitInternal);
  }
}

}  // namespace stiction
