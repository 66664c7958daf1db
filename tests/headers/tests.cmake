# Every public header compiles alone: one generated source per header that includes nothing else. With the implementations
# included each would take three times as long; that they include what they need shows in src, where each is compiled by
# itself, and that all of them get along with each other in one source of headers only.
file(GLOB_RECURSE public_headers RELATIVE ${PROJECT_SOURCE_DIR}/include CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/*.h)
list(FILTER public_headers EXCLUDE REGEX "/detail/")
set(all_headers "")
foreach(header ${public_headers})
  string(MAKE_C_IDENTIFIER ${header} name)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n")
  list(APPEND header_sources ${source})
  string(APPEND all_headers "#include \"${header}\"\n")
endforeach()
add_library(mspskel_public_headers OBJECT ${header_sources})
target_link_libraries(mspskel_public_headers PRIVATE mspskel)
target_compile_options(mspskel_public_headers PRIVATE -O0)
mspskel_target_warnings(mspskel_public_headers)

set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/all_public_headers.cpp)
file(CONFIGURE OUTPUT ${source} CONTENT "${all_headers}")
add_library(mspskel_all_public_headers OBJECT ${source})
target_link_libraries(mspskel_all_public_headers PRIVATE mspskel_header_only)
target_compile_options(mspskel_all_public_headers PRIVATE -O0)
mspskel_target_warnings(mspskel_all_public_headers)
