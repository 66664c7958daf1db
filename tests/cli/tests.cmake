# Tests that run the program itself; each *_test.py is a unittest module.
file(GLOB cli_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/cli/*_test.py)
foreach(test ${cli_tests})
  get_filename_component(name ${test} NAME_WE)
  string(REPLACE "_test" "" name ${name})
  string(REPLACE "_" " " name ${name})
  add_test(NAME "cli: ${name}" COMMAND Python3::Interpreter -B ${test})
  set_tests_properties("cli: ${name}" PROPERTIES ENVIRONMENT MSPSKEL_PROGRAM=$<TARGET_FILE:mspskel_cli>)
endforeach()
# The longest of all start first, so that nothing waits for them alone.
set_tests_properties("cli: ranges" PROPERTIES COST 100)

add_test(NAME "cli: files in the programs that read them"
  COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/cli/readers.py $<TARGET_FILE:mspskel_cli> ${PROJECT_SOURCE_DIR}
    ${PROJECT_BINARY_DIR}/readers_test)
# 77: no VTK or networkx to be had.
set_tests_properties("cli: files in the programs that read them" PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
