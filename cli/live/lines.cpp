// SPDX-License-Identifier: Apache-2.0
// stiction-live: a request a line, an answer a line. For the tests.

#include <iostream>

#include "cli/live/live.h"

int main() {
  for (std::string request; std::getline(std::cin, request);)
    std::cout << stiction::AnswerLive(request) << "\n";
}
