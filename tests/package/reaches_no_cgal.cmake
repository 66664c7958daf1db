# Fails if an object in BINARY_DIR was made from a CGAL header.
find_program(ninja NAMES ninja ninja-build REQUIRED)
execute_process(COMMAND ${ninja} -C ${BINARY_DIR} -t deps OUTPUT_VARIABLE dependencies COMMAND_ERROR_IS_FATAL ANY)
if(NOT dependencies MATCHES "mspskel/mesh/surface_snapshot.h")
  message(FATAL_ERROR "no dependencies were recorded, so nothing was checked")
endif()
if(dependencies MATCHES "[^\n]*/CGAL/[^\n]*")
  message(FATAL_ERROR "reached: ${CMAKE_MATCH_0}")
endif()
