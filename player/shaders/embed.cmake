# Writes OUTPUT, a C++ file that defines a string for each of the GLSL files FILES: surface.vert becomes
# surface_vert (shaders/sources.h). Run with cmake -DOUTPUT=... -DFILES=... -P embed.cmake.
set(text "// Made by player/shaders/embed.cmake from GLSL files.\n")
string(APPEND text "#include <string_view>\n\nnamespace paim::player::shaders {\n\n")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    string(MAKE_C_IDENTIFIER ${name} identifier)
    file(READ ${file} source)
    string(APPEND text "extern const std::string_view ${identifier};\n")
    string(APPEND text "const std::string_view ${identifier} = R\"glsl(${source})glsl\";\n\n")
endforeach()
string(APPEND text "}  // namespace paim::player::shaders\n")
file(WRITE ${OUTPUT} "${text}")
