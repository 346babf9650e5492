# CPack runs this on the files of each package before it packs them: what Debian wants and other systems do not. Files that differ between
# the packages are named after them. Dates are SOURCE_DATE_EPOCH's where it is set.
set(here ${CMAKE_CURRENT_LIST_DIR})
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)

function(compress file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  set(package ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
  set(doc ${share}/doc/${package})

  file(MAKE_DIRECTORY ${doc})
  file(COPY_FILE ${here}/copyright ${doc}/copyright)
  file(COPY_FILE ${here}/../../CHANGELOG.md ${doc}/changelog)
  file(WRITE ${doc}/changelog.Debian "${CPACK_PACKAGE_NAME} (${version}) unstable; urgency=medium\n\n"
                                     "  * Packaged from the sources of this version, see changelog.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  compress(${doc}/changelog)
  compress(${doc}/changelog.Debian)
  if(EXISTS ${here}/${package}.lintian-overrides)
    file(MAKE_DIRECTORY ${share}/lintian/overrides)
    file(COPY_FILE ${here}/${package}.lintian-overrides ${share}/lintian/overrides/${package})
  endif()

  # the same again, for which Debian has other places
  file(REMOVE ${share}/doc/musim/LICENSE ${share}/doc/musim/CHANGELOG.md)
  file(GLOB pages ${share}/man/man1/*.1)
  foreach(page IN LISTS pages)
    compress(${page})
  endforeach()
  if(EXISTS ${share}/zsh/site-functions)
    file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
  endif()
  # folders of the sources that had nothing to install
  execute_process(COMMAND find ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component} -type d -empty -delete COMMAND_ERROR_IS_FATAL ANY)
endforeach()
