add_test(NAME "package: installs and serves a consumer project"
  COMMAND ${CMAKE_COMMAND} -DBINARY_DIR=${PROJECT_BINARY_DIR} -DSOURCE_DIR=${CMAKE_CURRENT_SOURCE_DIR}/package
    -DWORK_DIR=${CMAKE_CURRENT_BINARY_DIR}/package -DGENERATOR=${CMAKE_GENERATOR} -DBUILD_TYPE=$<CONFIG>
    -DCXX_COMPILER=${CMAKE_CXX_COMPILER} -P ${CMAKE_CURRENT_SOURCE_DIR}/package/install_and_consume.cmake)

add_test(NAME "package: the recipes of the docs build and run"
  COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/package/recipes_test.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}
    ${CMAKE_CURRENT_BINARY_DIR}/recipes ${CMAKE_CXX_COMPILER} ${CMAKE_GENERATOR} $<CONFIG>)
set_tests_properties("package: the recipes of the docs build and run" PROPERTIES TIMEOUT 1200)

# A build without CGAL: no object of it was made from a CGAL header. Ninja keeps the dependencies in one place.
if(NOT MSPSKEL_WITH_CGAL AND CMAKE_GENERATOR STREQUAL "Ninja")
  add_test(NAME "package: the core is built without any CGAL header"
    COMMAND ${CMAKE_COMMAND} -DBINARY_DIR=${PROJECT_BINARY_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/package/reaches_no_cgal.cmake)
endif()
