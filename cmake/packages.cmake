# SPDX-License-Identifier: Apache-2.0
# What is installed besides programs and library, and `cpack`: the Debian packages stiction,
# libstiction-dev and python3-stiction.
include(GNUInstallDirs)

# compressed(FILE): FILE.gz in the build, when it is configured; without name and time.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
function(compressed file)
  cmake_path(GET file FILENAME name)
  execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${PROJECT_BINARY_DIR}/packages/${name}.gz
                  COMMAND_ERROR_IS_FATAL ANY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endfunction()
configure_file(cmake/debian/stiction-ipopt.1.in ${PROJECT_BINARY_DIR}/packages/stiction-ipopt.1 @ONLY)
compressed(${PROJECT_BINARY_DIR}/packages/stiction-ipopt.1)
compressed(${PROJECT_SOURCE_DIR}/cmake/debian/changelog)

# The manuals, the completion and the schemas, written by the program itself.
set(manual ${PROJECT_BINARY_DIR}/packages/stiction.1)
set(manual_of_bench ${PROJECT_BINARY_DIR}/packages/stiction-bench.1)
set(completion ${PROJECT_BINARY_DIR}/packages/completion)
set(schemas ${PROJECT_BINARY_DIR}/packages/schemas)
add_custom_command(OUTPUT ${manual} ${manual}.gz ${manual_of_bench} ${manual_of_bench}.gz ${completion}
  COMMAND stiction manual > ${manual}
  COMMAND gzip -9nc ${manual} > ${manual}.gz
  COMMAND stiction manual --format man-bench > ${manual_of_bench}
  COMMAND gzip -9nc ${manual_of_bench} > ${manual_of_bench}.gz
  COMMAND stiction manual --format bash > ${completion}
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${schemas}
  COMMAND stiction manual --schemas ${schemas}
  DEPENDS stiction COMMENT "Writing the manual" VERBATIM)
add_custom_target(stiction_manual ALL DEPENDS ${manual}.gz ${manual_of_bench}.gz ${completion})

install(FILES ${manual}.gz ${manual_of_bench}.gz ${PROJECT_BINARY_DIR}/packages/stiction-ipopt.1.gz
        DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME stiction
        COMPONENT program)
install(PROGRAMS certify/check_certificate.py certify/check_runs.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/stiction/certify COMPONENT program)
install(FILES certify/certificate_reader.py certify/check_runs_in_space.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/stiction/certify COMPONENT program)
install(DIRECTORY corpus/ DESTINATION ${CMAKE_INSTALL_DATADIR}/stiction/corpus COMPONENT program
        FILES_MATCHING PATTERN "*.json" PATTERN "formats" EXCLUDE PATTERN "large" EXCLUDE PATTERN "peers" EXCLUDE
                       PATTERN "space" EXCLUDE)
install(DIRECTORY search/campaigns DESTINATION ${CMAKE_INSTALL_DATADIR}/stiction COMPONENT program
        FILES_MATCHING PATTERN "*.json")
install(DIRECTORY ${schemas} DESTINATION ${CMAKE_INSTALL_DATADIR}/stiction COMPONENT program
        FILES_MATCHING PATTERN "*.schema.json")

set(components program library)
set(package_of_program stiction)
set(package_of_library libstiction-dev)
if(STICTION_PYTHON)
  list(APPEND components python)
  set(package_of_python python3-stiction)
  install(FILES python/engine_step.ipynb python/headline.ipynb python/study.ipynb DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-stiction/examples
          COMPONENT python)
endif()
foreach(component ${components})
  set(package ${package_of_${component}})
  install(FILES cmake/debian/${package}.copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
          COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/packages/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          RENAME changelog.Debian.gz COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The stiction authors")
set(CPACK_PACKAGE_CONTACT "The stiction authors <authors@stiction.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME stiction)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS python3)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "searches for endless runs of a contact force algorithm
Does the pivoting algorithm of D. Baraff for contact forces with friction
(1994) always end? stiction searches for problems on which it loops, replays
them step by step, certifies them in exact arithmetic, and reports on them.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libstiction-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libeigen3-dev, libsuitesparse-dev")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "pivoting methods for contact forces with friction, as a library
Headers, static libraries and CMake files for C++, and stiction.h for C: the
published algorithm of D. Baraff (1994) under every reading of its text,
complete driving, which always ends, and Newton's method for engines.")
# The module is of one version of the interpreter; of numpy it takes what every version has.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-stiction)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS stiction)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/debian/python3/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/python3/prerm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "contact forces with friction by pivoting, from Python
Problems from arrays of numpy or files: solved, replayed step by step,
certified in exact arithmetic; and campaigns that search for problems on which
the algorithm of D. Baraff (1994) loops, as findings and tables.")
include(CPack)
