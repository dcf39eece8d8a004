# `cpack` in the build folder: a Debian package of all that is installed. scripts/package builds one,
# installs it, uses it and removes it again.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME wordgaze)
set(CPACK_PACKAGE_VENDOR "The Wordgaze authors")
set(CPACK_PACKAGE_CONTACT "The Wordgaze authors <wordgaze@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What the headers include, for those who build against them.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libcairo2-dev, liblcm-dev")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
include(CPack)
