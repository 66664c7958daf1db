add_test(NAME "view: the page is built from its sources"
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/view/bundle_test.py ${PROJECT_SOURCE_DIR})
if(MSPSKEL_BUILD_APPS)
  add_test(NAME "view: the page in a browser"
    COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/view/page_test.py $<TARGET_FILE:mspskel_cli> ${PROJECT_SOURCE_DIR}
      ${PROJECT_BINARY_DIR}/page_test)
  # 77: no chromium, node or playwright-core here.
  set_tests_properties("view: the page in a browser" PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
endif()
