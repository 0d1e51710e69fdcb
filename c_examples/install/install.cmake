# Files that `cmake --install` installs: the libraries, the header and the Fortran module's source,
# signorini.pc, the CMake package, licences and a page for man. install.sh installs the same without CMake, but for
# Windows, where programs of both kinds of compilers are served.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(libdir "${CMAKE_INSTALL_LIBDIR}")
set(includedir "${CMAKE_INSTALL_INCLUDEDIR}")
set(bindir "${CMAKE_INSTALL_BINDIR}")

install(FILES "${root}/include/signorini.h" "${root}/include/signorini_file.h"
    "${root}/include/signorini_surface.h" DESTINATION "${includedir}")
install(FILES "${root}/include/signorini.f90" "${root}/include/signorini.inc"
    DESTINATION "${includedir}")
install(FILES "${static}" DESTINATION "${libdir}")
install(FILES "${root}/LICENSE-MIT" "${root}/LICENSE-APACHE" "${root}/LICENSE-THIRD-PARTY"
    DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/signorini")
if(NOT WIN32)
    install(FILES "${root}/c_examples/install/signorini.7" DESTINATION "${CMAKE_INSTALL_MANDIR}/man7")
endif()

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
set(import_name)
if(WIN32)
    # An import library says which functions the DLL has. Microsoft's and Intel's compilers look for signorini.lib;
    # signorini.def lists the functions for all others.
    install(PROGRAMS "${shared}" DESTINATION "${CMAKE_INSTALL_BINDIR}")
    install(FILES "${root}/include/signorini.def" DESTINATION "${libdir}")
    if(MSVC)
        install(FILES "${import_library}" DESTINATION "${libdir}" RENAME signorini.lib)
    else()
        install(FILES "${import_library}" DESTINATION "${libdir}")
        set(for_microsoft "${CMAKE_CURRENT_BINARY_DIR}/signorini.lib")
        add_custom_command(OUTPUT "${for_microsoft}"
            COMMAND "${CMAKE_DLLTOOL}" -m i386:x86-64 -D signorini.dll -l "${for_microsoft}"
                -d "${root}/include/signorini.def"
            DEPENDS "${root}/include/signorini.def"
            VERBATIM)
        add_custom_target(library_for_microsoft ALL DEPENDS "${for_microsoft}")
        install(FILES "${for_microsoft}" DESTINATION "${libdir}")
    endif()
else()
    install(PROGRAMS "${shared}" DESTINATION "${libdir}" RENAME "${shared_name}")
endif()
get_filename_component(static_name "${static}" NAME)

# The CMake package finds its files from its own place.
set(package "${libdir}/cmake/signorini")
set(private "${private_libraries}")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/signorini-config.cmake.in"
    signorini-config.cmake
    INSTALL_DESTINATION "${package}" PATH_VARS libdir includedir bindir
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
