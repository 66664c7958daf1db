if(MSPSKEL_BUILD_APPS)
  add_test(NAME "rig: the glTF validator"
    COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/rig/gltf_test.py $<TARGET_FILE:mspskel_cli>
      ${PROJECT_BINARY_DIR}/gltf_test ${PROJECT_SOURCE_DIR}/../shared/meshes)
  # 77: no node, or the validator cannot be had.
  set_tests_properties("rig: the glTF validator" PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
endif()
