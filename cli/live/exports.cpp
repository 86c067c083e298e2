// SPDX-License-Identifier: Apache-2.0
// What the WebAssembly module exports. A request is written to RequestBytes(size); AnswerBytes() answers it.

#include <cstddef>
#include <string>

#include "cli/live/live.h"

namespace {

std::string request, answer;

}  // namespace

extern "C" {

[[clang::export_name("request")]] char* RequestBytes(std::size_t size) {
  request.assign(size, '\0');
  return request.data();
}

[[clang::export_name("answer")]] const char* AnswerBytes() {
  answer = stiction::AnswerLive(request);
  return answer.data();
}

[[clang::export_name("size")]] std::size_t AnswerSize() { return answer.size(); }

}  // extern "C"
