# `cmake --install` puts the libraries, headers and a package file in place, so that others write find_package(musim).
include(CMakePackageConfigHelpers)

get_property(musim_modules GLOBAL PROPERTY MUSIM_MODULES)
install(TARGETS ${musim_modules} EXPORT musimTargets)
install(TARGETS musim RUNTIME)
foreach(folder scaling records lsdem)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/musim FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(FILES lsdem/scene/musim-scene-1.schema.json scaling/musim-law-1.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/musim)
install(DIRECTORY scaling/laws DESTINATION ${CMAKE_INSTALL_DATADIR}/musim FILES_MATCHING PATTERN "*.json")
install(EXPORT musimTargets NAMESPACE musim:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/musim)
configure_package_config_file(cmake/musimConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/musimConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/musim)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/musimConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/musimConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/musimConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/musim)
