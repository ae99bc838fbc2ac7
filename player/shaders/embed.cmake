# Writes OUTPUT, a C++ file that defines what shaders/sources.h declares, from the GLSL files FILES:
# model.vert becomes model_vert. Run with cmake -DOUTPUT=... -DFILES=... -P embed.cmake.
set(text "// Made by player/shaders/embed.cmake from the GLSL files in player/shaders.\n")
string(APPEND text "#include \"player/shaders/sources.h\"\n\nnamespace paim::player::shaders {\n\n")
foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    string(MAKE_C_IDENTIFIER ${name} identifier)
    file(READ ${file} source)
    string(APPEND text "const std::string_view ${identifier} = R\"glsl(${source})glsl\";\n\n")
endforeach()
string(APPEND text "}  // namespace paim::player::shaders\n")
file(WRITE ${OUTPUT} "${text}")
