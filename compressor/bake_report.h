// The report of paim-compress about a bake, as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "compressor/bake/bake_options.h"
#include "compressor/bake/bake_sequence.h"
#include "compressor/io/vertex_colours.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/root_motion.h"

namespace paim {

// Oddities of the still mesh of one file.
struct StillMeshReport {
    std::string file;
    TopologyReport topology;
    PoseReport pose;
    VertexColours vertex_colours;
    size_t num_inward = 0;
};

struct BakeReport {
    std::filesystem::path bake;
    BakeOptions options;
    uint32_t num_vertices = 0;  // of a pose, with its floor
    size_t num_triangles = 0;
    uint32_t num_poses = 0;  // of the whole sequence
    uint32_t first_pose = 0, last_pose = 0;
    uint32_t channels = 1;   // of the transfer
    RootMotion root_motion;  // that was taken out; empty if none
    std::string floor;       // description; empty if there is none
    double origin_y = 0.0;   // y of the origin of the floor's height, scene units
    uint32_t still_vertices = 0;
    size_t still_triangles = 0;
    VertexColours vertex_colours;  // of the poses
    TopologyReport topology;       // of the poses without their floor
    size_t num_inward = 0;         // closed parts that face inwards, or did before they were turned
    std::vector<StillMeshReport> still_meshes;
    BakeSummary summary;

    // Averages over vertices with a normal and over rays; 0 if there are none.
    double rays_per_vertex() const;
    double occluded_share() const;
    double back_hit_share() const;
};

nlohmann::ordered_json report_json(const BakeReport& report);

// Lines, each with a line feed.
std::string report_text(const BakeReport& report);

}  // namespace paim
