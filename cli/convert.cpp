// SPDX-License-Identifier: Apache-2.0
#include "cli/convert.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "corpus/descriptor.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

constexpr const char* kConverter = "rsvg-convert";

// Its environment, with no moment in a PDF.
std::vector<std::string> Timeless() {
  std::vector<std::string> variables = {"SOURCE_DATE_EPOCH=0"};
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::strncmp(*variable, "SOURCE_DATE_EPOCH=", 18) != 0) variables.emplace_back(*variable);
  return variables;
}

// Exit status of the program between two files; 0 if it did all. -1 if it cannot be started; errno says why.
int Run(std::vector<std::string> words, int input, int output) {
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
  };
  std::vector<std::string> variables = Timeless();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  pid_t id = 0;
  errno = posix_spawnp(&id, words[0].c_str(), &actions, nullptr, pointers(words).data(),
                       pointers(variables).data());
  const bool started = errno == 0;
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (!started) return -1;
  while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

std::string Converted(const std::string& svg, const std::string& format) {
  const Descriptor input = FileInMemory("svg", svg), output = FileInMemory("picture");
  if (!input.valid() || !output.valid()) throw InputError("--output: no memory for the picture");
  std::vector<std::string> words = {kConverter, "--format", format};
  if (format == "png") words.insert(words.end(), {"--zoom", "2"});
  const int status = Run(std::move(words), input.number(), output.number());
  if (status < 0)
    throw InputError(
        fmt::format("--output: {} for a .{}: {}; expected it installed: Debian's package librsvg2-bin. "
                    "An .svg needs nothing",
                    kConverter, format, std::strerror(errno)));
  if (status != 0) throw InputError(fmt::format("--output: {} ended with status {}", kConverter, status));
  std::string picture(static_cast<std::size_t>(lseek(output.number(), 0, SEEK_END)), '\0');
  std::size_t read = 0;
  while (read < picture.size()) {
    const ssize_t count =
        pread(output.number(), picture.data() + read, picture.size() - read, static_cast<off_t>(read));
    if (count <= 0) throw InputError("--output: the picture cannot be read back");
    read += static_cast<std::size_t>(count);
  }
  return picture;
}

}  // namespace stiction
