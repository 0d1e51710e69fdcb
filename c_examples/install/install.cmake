# Files that `cmake --install` installs: the libraries, the header and the Fortran module's source,
# signorini.pc and the CMake package. install.sh installs the same without CMake.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(libdir "${CMAKE_INSTALL_LIBDIR}")
set(includedir "${CMAKE_INSTALL_INCLUDEDIR}")

install(FILES "${root}/include/signorini.h" "${root}/include/signorini_file.h"
    "${root}/include/signorini_surface.h" DESTINATION "${includedir}")
install(FILES "${root}/include/signorini.f90" "${root}/include/signorini.inc"
    DESTINATION "${includedir}")
install(FILES "${static}" DESTINATION "${libdir}")

# The shared library under its whole version; links for those who run and who link programs.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    set(shared_name "libsignorini.so.${version}")
    set(links "${CMAKE_CURRENT_BINARY_DIR}/links")
    file(MAKE_DIRECTORY "${links}")
    file(CREATE_LINK "${shared_name}" "${links}/libsignorini.so.${interface}" SYMBOLIC)
    file(CREATE_LINK "libsignorini.so.${interface}" "${links}/libsignorini.so" SYMBOLIC)
    install(FILES "${links}/libsignorini.so.${interface}" "${links}/libsignorini.so"
        DESTINATION "${libdir}")
else()
    get_filename_component(shared_name "${shared}" NAME)
endif()
install(PROGRAMS "${shared}" DESTINATION "${libdir}" RENAME "${shared_name}")

# The CMake package finds its files from its own place.
set(package "${libdir}/cmake/signorini")
set(private "${private_libraries}")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/signorini-config.cmake.in"
    signorini-config.cmake
    INSTALL_DESTINATION "${package}" PATH_VARS libdir includedir
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/signorini-config-version.cmake"
    VERSION "${version}" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/signorini-config.cmake"
    "${CMAKE_CURRENT_BINARY_DIR}/signorini-config-version.cmake" DESTINATION "${package}")

# signorini.pc holds the prefix, which is known for sure only at the installation: cmake --install
# --prefix. pkg-config wants a backslash in front of a space.
list(TRANSFORM private PREPEND "-l")
list(JOIN private " " private)
foreach(directory libdir includedir)
    if(NOT IS_ABSOLUTE "${${directory}}")
        string(PREPEND ${directory} "\${prefix}/")
    endif()
endforeach()
set(pc "${CMAKE_CURRENT_BINARY_DIR}/signorini.pc")
install(CODE "
    string(REPLACE [[ ]] [[\\ ]] prefix \"\${CMAKE_INSTALL_PREFIX}\")
    set(libdir [[${libdir}]])
    set(includedir [[${includedir}]])
    set(version \"${version}\")
    set(private \"${private}\")
    configure_file([[${CMAKE_CURRENT_LIST_DIR}/signorini.pc.in]] [[${pc}]] @ONLY)")
install(FILES "${pc}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
