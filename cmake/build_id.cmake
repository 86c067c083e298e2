# SPDX-License-Identifier: Apache-2.0
# Writes build_id.h, which says what this build was made of. Run at every build; the header changes only when
# what it says does.
#
#   set(build_id ${PROJECT_BINARY_DIR}/generated/build_id.h)
#   add_custom_target(stiction_build_id
#     COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DOUTPUT=${build_id}
#             -DVERSION=${PROJECT_VERSION} "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
#             -DBUILD_TYPE=$<CONFIG> "-DFLAGS=${flags}" -P ${PROJECT_SOURCE_DIR}/cmake/build_id.cmake
#     BYPRODUCTS ${build_id} COMMENT "Writing build_id.h" VERBATIM)
#   add_dependencies(USER stiction_build_id)
#   target_include_directories(USER PRIVATE ${PROJECT_BINARY_DIR}/generated)
#
# kCommit is `<commit>` where the files below are as committed, otherwise `<commit>-dirty-<hash of the
# differences>`; outside a checkout, or without git, `unknown-<hash of the files>`.
cmake_minimum_required(VERSION 3.25)

# What a result can depend on. Untracked files do not count.
set(folders solver scene corpus certify search reports cli)

# ARGN: git's arguments. Sets `out` to its output, and to "" if it fails or is not installed.
function(git out)
  # The checkout may belong to another user (containers). No lock, no user's taste in diffs.
  execute_process(COMMAND git -C ${SOURCE_DIR} -c safe.directory=* --no-optional-locks ${ARGN}
                  OUTPUT_VARIABLE text RESULT_VARIABLE status ERROR_QUIET)
  if(NOT status EQUAL 0)
    set(text "")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

function(short_hash out text)
  string(SHA256 hash "${text}")
  string(SUBSTRING "${hash}" 0 8 hash)
  set(${out} ${hash} PARENT_SCOPE)
endfunction()

function(hash_of_files out)
  list(TRANSFORM folders PREPEND ${SOURCE_DIR}/ OUTPUT_VARIABLE patterns)
  list(TRANSFORM patterns APPEND /*)
  file(GLOB_RECURSE files RELATIVE ${SOURCE_DIR} ${patterns})
  list(FILTER files EXCLUDE REGEX __pycache__)
  set(text "")
  foreach(file IN LISTS files ITEMS CMakeLists.txt)
    file(SHA256 ${SOURCE_DIR}/${file} hash)
    string(APPEND text "${file} ${hash}\n")
  endforeach()
  short_hash(hash "${text}")
  set(${out} ${hash} PARENT_SCOPE)
endfunction()

function(describe_commit out)
  # A prefix means that the repository found is not ours but one around us.
  git(text rev-parse --show-prefix --short=12 HEAD)
  if(NOT text MATCHES "^\n([0-9a-f]+)\n$")
    hash_of_files(hash)
    set(${out} unknown-${hash} PARENT_SCOPE)
    return()
  endif()
  set(commit ${CMAKE_MATCH_1})
  git(differences diff HEAD --no-ext-diff --no-textconv --no-color --no-renames --full-index --unified=3
      --diff-algorithm=myers --src-prefix=a/ --dst-prefix=b/ -- ${folders} CMakeLists.txt)
  if(NOT differences STREQUAL "")
    short_hash(hash "${differences}")
    string(APPEND commit -dirty-${hash})
  endif()
  set(${out} ${commit} PARENT_SCOPE)
endfunction()

foreach(variable GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE)  # set where git runs us from a hook
  unset(ENV{${variable}})
endforeach()
describe_commit(COMMIT)

set(header "// Written by cmake/build_id.cmake.
#ifndef STICTION_BUILD_ID_H_
#define STICTION_BUILD_ID_H_

#include <string_view>

namespace stiction::build_id {

")
foreach(constant Version Commit Compiler BuildType Flags)
  string(REGEX REPLACE "([a-z])([A-Z])" "\\1_\\2" variable ${constant})
  string(TOUPPER ${variable} variable)
  string(STRIP "${${variable}}" value)
  string(REGEX REPLACE "([\\\"])" "\\\\\\1" value "${value}")
  string(APPEND header "inline constexpr std::string_view k${constant} = \"${value}\";\n")
endforeach()
string(APPEND header "
}  // namespace stiction::build_id

#endif  // STICTION_BUILD_ID_H_
")

set(written "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} written)
endif()
if(NOT header STREQUAL written)
  file(WRITE ${OUTPUT} "${header}")
endif()
