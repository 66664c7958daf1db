# The pipeline's fuzz targets as a plain program: pipeline_fuzz --help. Under ctest the same inputs every time.
find_package(CLI11 REQUIRED)
add_executable(pipeline_fuzz fuzz/pipeline_driver.cpp)
target_link_libraries(pipeline_fuzz PRIVATE mspskel_run CLI11::CLI11)
target_include_directories(pipeline_fuzz PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
mspskel_target_warnings(pipeline_fuzz)
add_test(NAME "pipeline_fuzz" COMMAND pipeline_fuzz --seed 1 --runs 400 --seconds 60)
add_test(NAME "pipeline_fuzz: soups" COMMAND pipeline_fuzz --soups --seed 1 --runs 200 --seconds 60)
set_tests_properties("pipeline_fuzz" "pipeline_fuzz: soups" PROPERTIES ENVIRONMENT OMP_WAIT_POLICY=passive)
