# The Python package's tests, on the extension that this build made.
if(MSPSKEL_BUILD_PYTHON)
  add_test(NAME "python: pytest" COMMAND ${MSPSKEL_PYTHON_EXECUTABLE} -m pytest -q -p no:cacheprovider ${PROJECT_SOURCE_DIR}/python/tests
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties("python: pytest" PROPERTIES TIMEOUT 900 COST 90 ENVIRONMENT
    "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;MSPSKEL_PROGRAM=$<$<TARGET_EXISTS:mspskel_cli>:$<TARGET_FILE:mspskel_cli>>")
else()
  add_test(NAME "python: pytest"
    COMMAND ${CMAKE_COMMAND} -E echo "skipped: built without the Python module (scripts/python_env.sh, MSPSKEL_BUILD_PYTHON)")
  set_tests_properties("python: pytest" PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped")
endif()
