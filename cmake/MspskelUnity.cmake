option(MSPSKEL_UNITY_BUILD "Compile each folder of sources as one translation unit; OFF: each source, and each public header, by itself" ON)

# Parsing OpenMesh, Eigen and JSON costs more than most sources themselves, so that each folder of the target's sources is one
# translation unit. To be called after the last target_sources. Without MSPSKEL_UNITY_BUILD each source shows that it stands alone.
function(mspskel_target_unity target)
  if(NOT MSPSKEL_UNITY_BUILD)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE OUTPUT_VARIABLE path)
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
  endforeach()
endfunction()
