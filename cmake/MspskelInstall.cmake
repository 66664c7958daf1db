# `cmake --install` makes a package for find_package(mspskel) with mspskel::mspskel and mspskel::header_only.
include(CMakePackageConfigHelpers)
set(mspskel_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mspskel)

install(TARGETS mspskel mspskel_header_only EXPORT mspskelTargets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT mspskelTargets NAMESPACE mspskel:: DESTINATION ${mspskel_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/mspskelConfig.cmake.in ${PROJECT_BINARY_DIR}/mspskelConfig.cmake
  INSTALL_DESTINATION ${mspskel_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mspskelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mspskelConfig.cmake ${PROJECT_BINARY_DIR}/mspskelConfigVersion.cmake
  DESTINATION ${mspskel_package_dir})
