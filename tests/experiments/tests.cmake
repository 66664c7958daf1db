add_test(NAME "experiments: page" COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_LIST_DIR}/experiments_test.py)
set_tests_properties("experiments: page" PROPERTIES ENVIRONMENT MSPSKEL_EXPERIMENTS=$<TARGET_FILE:mspskel_experiments>)
