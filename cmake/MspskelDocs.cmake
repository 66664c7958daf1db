# Target `docs`: the reference in docs/html of the build directory. Any warning of Doxygen is an error.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  find_package(Python3 3.9 COMPONENTS Interpreter REQUIRED)
  configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(docs COMMAND Doxygen::doxygen ${PROJECT_BINARY_DIR}/Doxyfile
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()
