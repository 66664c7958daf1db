find_package(Python3 3.9 COMPONENTS Interpreter REQUIRED)
add_test(NAME "layers: headers include only folders above their own"
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/layers/check_layers.py ${PROJECT_SOURCE_DIR})
