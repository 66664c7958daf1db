if(MSPSKEL_BUILD_APPS)
  foreach(test "the glTF validator=gltf" "limbs bend in three.js=bend")
    string(REGEX MATCH "^(.*)=(.*)$" _ "${test}")
    add_test(NAME "rig: ${CMAKE_MATCH_1}"
      COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/rig/${CMAKE_MATCH_2}_test.py $<TARGET_FILE:mspskel_cli>
        ${PROJECT_BINARY_DIR}/${CMAKE_MATCH_2}_test ${PROJECT_SOURCE_DIR}/../shared/meshes)
    # 77: no node or chromium, or the packages cannot be had.
    set_tests_properties("rig: ${CMAKE_MATCH_1}" PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1500)
  endforeach()
endif()
