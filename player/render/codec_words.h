// What the player calls the things that only one codec has: on its command line, in its panels and
// reports.
#pragma once

#include <span>
#include <string_view>

namespace paim::player {

// Of a codec whose vertices combine components of their own (TransferModel::num_vertex_components).
struct CodecWords {
    std::string_view codec;
    const char* option;       // that limits these components: "--…-components"
    const char* components;   // for people: "… components"
    const char* description;  // of the option, for --help
    // Work that is done once a frame for all vertices (FrameCost::cpu_per_frame): in a sentence, "a
    // frame for …", and in JSON.
    const char* shared_work;
    const char* shared_work_json;
};

// Of every codec that has such components. transfer_textures.cpp is the one place that names
// codecs.
std::span<const CodecWords> codec_words();

// Of the codec of this name; nullptr if its vertices have no components of their own.
const CodecWords* words_of_codec(std::string_view codec);

}  // namespace paim::player
