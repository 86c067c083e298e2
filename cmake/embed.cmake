# SPDX-License-Identifier: Apache-2.0
# Writes a header with the text of a file as a constant.
#
#   add_custom_command(OUTPUT page.h COMMAND ${CMAKE_COMMAND} -DINPUT=page.html -DOUTPUT=page.h -DNAME=kPage
#                      -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake DEPENDS page.html embed.cmake)
cmake_minimum_required(VERSION 3.25)

# As bytes: text would lose what CMake's lists and escapes take for their own.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
cmake_path(GET INPUT FILENAME file)
file(WRITE ${OUTPUT} "// Written by cmake/embed.cmake from ${file}.
#ifndef STICTION_EMBEDDED_${NAME}
#define STICTION_EMBEDDED_${NAME}

namespace stiction {

inline constexpr unsigned char ${NAME}[] = {
${bytes}
};

}  // namespace stiction

#endif
")
