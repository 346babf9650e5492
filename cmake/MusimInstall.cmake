# `cmake --install` puts all in its standard place, as three components: program, development (libraries, headers and a package file, so that
# others write find_package(musim)) and documentation, which keeps the folders of the sources, so that links between pages hold.
include(CMakePackageConfigHelpers)
set(musim_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/musim)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS musim RUNTIME)
install(DIRECTORY ${MUSIM_PAGES}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${MUSIM_PAGES}/bash/musim DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${MUSIM_PAGES}/zsh/_musim DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES lsdem/scene/musim-scene-1.schema.json scaling/musim-law-1.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/musim)
install(DIRECTORY scaling/laws DESTINATION ${CMAKE_INSTALL_DATADIR}/musim FILES_MATCHING PATTERN "*.json")
install(FILES scripts/paraview_blocks.py DESTINATION ${CMAKE_INSTALL_DATADIR}/musim)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
get_property(musim_modules GLOBAL PROPERTY MUSIM_MODULES)
install(TARGETS ${musim_modules} EXPORT musimTargets)
foreach(folder scaling records lsdem)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/musim FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(EXPORT musimTargets NAMESPACE musim:: DESTINATION ${musim_package_folder})
configure_package_config_file(cmake/musimConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/musimConfig.cmake INSTALL_DESTINATION ${musim_package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/musimConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/musimConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/musimConfigVersion.cmake DESTINATION ${musim_package_folder})

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME documentation)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(folder docs scaling records lsdem cli)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_DOCDIR}
          FILES_MATCHING PATTERN "*.md" REGEX "/docs/.*[.](svg|png)$")
endforeach()
# the site of scripts/docs, where it was made
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/docs/html DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
unset(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME)
