# Provides Httplib::httplib, Debian's libcpp-httplib-dev. It is split into a header and a library, which must
# see the same settings: pkg-config knows them.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(Httplib QUIET IMPORTED_TARGET cpp-httplib)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Httplib
  REQUIRED_VARS Httplib_LINK_LIBRARIES VERSION_VAR Httplib_VERSION
  REASON_FAILURE_MESSAGE "install libcpp-httplib-dev and pkg-config, or configure with -DWORDGAZE_WITH_HTTP=OFF")
if(Httplib_FOUND AND NOT TARGET Httplib::httplib)
  add_library(Httplib::httplib ALIAS PkgConfig::Httplib)
endif()
