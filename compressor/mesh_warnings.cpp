// Warnings of paim-compress about oddities of a mesh.
#include "compressor/mesh_warnings.h"

#include <fmt/format.h>

namespace paim {

namespace {

struct Kind {
    uint64_t count;
    const char* what;
    const char* meaning;
};

std::vector<std::string> lines(const std::string& mesh, const std::vector<Kind>& kinds) {
    std::vector<std::string> texts;
    for (const Kind& kind : kinds) {
        if (kind.count == 0) continue;
        texts.push_back(fmt::format("{}: {} {}: {}", mesh, kind.count, kind.what, kind.meaning));
    }
    return texts;
}

std::vector<Kind> kinds_of(const TopologyReport& report) {
    return {
        {report.isolated_vertices, "vertices belong to no face",
         "they stay in the file, without transfer and at one place, and count for nothing"},
        {report.duplicate_faces, "faces have the vertices of an earlier one",
         "they count once for normals"},
        {report.back_faces, "faces are the back of an earlier one, with its vertices",
         "only the side of the first is lit; give the back vertices of its own to light both"},
        {report.boundary_edges, "edges belong to one face",
         "open sheets are lit on their front side only; light passes through seams that do not "
         "meet"},
        {report.flipped_edges, "edges join two faces that face opposite sides",
         "vertex normals there average both and light is wrong; make the orientation consistent"},
        {report.non_manifold_edges, "edges join three or more faces",
         "vertex normals there average them all"},
    };
}

constexpr const char* kNoArea = "they have no normal and block nothing";
constexpr const char* kCoincident = "neither shadows the other, each is lit on its own side";

}  // namespace

std::vector<std::string> mesh_warnings(const TopologyReport& report) {
    return lines("mesh", kinds_of(report));
}

std::vector<std::string> mesh_warnings(const PoseReport& total) {
    return lines(
        "mesh",
        {
            {total.zero_area_faces, "faces (over all poses) have no area", kNoArea},
            {total.coincident_faces, "faces (over all poses) lie exactly on another", kCoincident},
        });
}

std::vector<std::string> still_mesh_warnings(const std::string& file, const TopologyReport& report,
                                             const PoseReport& pose) {
    std::vector<Kind> kinds = kinds_of(report);
    kinds.push_back({pose.zero_area_faces, "faces have no area", kNoArea});
    kinds.push_back({pose.coincident_faces, "faces lie exactly on another", kCoincident});
    return lines(file, kinds);
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
}

nlohmann::ordered_json mesh_json(const TopologyReport& report, const PoseReport& total) {
    nlohmann::ordered_json json;
    json["isolated_vertices"] = report.isolated_vertices;
    json["duplicate_faces"] = report.duplicate_faces;
    json["back_faces"] = report.back_faces;
    json["boundary_edges"] = report.boundary_edges;
    json["flipped_edges"] = report.flipped_edges;
    json["non_manifold_edges"] = report.non_manifold_edges;
    json["zero_area_faces"] = total.zero_area_faces;
    json["coincident_faces"] = total.coincident_faces;
    return json;
}

}  // namespace paim
