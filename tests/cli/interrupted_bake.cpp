// A bake whose process dies at a place that is known beforehand: what `paim-compress bake` does
// with these files and options until then, without a chance to tidy up.
//   interrupted_bake POSES OUTPUT.bake RAYS BANDS after P     killed once pose P is finished
//                                                 reading P   killed as soon as pose P is read,
//                                                             while the one before is being baked
//                                                 writing N   killed by the N-th byte of any file
#include <signal.h>
#include <sys/resource.h>

#include <string>

#include "compressor/bake/bake_sequence.h"
#include "compressor/io/obj_files.h"
#include "compressor/io/obj_sequence.h"
#include "paim/base/parallel.h"
#include "paim/base/tbb_parallel.h"

namespace paim {
namespace {

constexpr uint32_t kNever = UINT32_MAX;

// Poses of which one is fatal to read.
class FatalPose : public PoseSource {
  public:
    FatalPose(const PoseSource& poses, uint32_t fatal) : poses_(poses), fatal_(fatal) {}

    const Topology& topology() const override { return poses_.topology(); }
    const Albedo& albedo() const override { return poses_.albedo(); }
    uint32_t num_poses() const override { return poses_.num_poses(); }
    std::string pose_name(uint32_t p) const override { return poses_.pose_name(p); }
    uint64_t pose_checksum(uint32_t p) const override { return poses_.pose_checksum(p); }
    Vec3d origin() const override { return poses_.origin(); }
    Pose load_pose(uint32_t p) const override {
        if (p == fatal_) ::kill(::getpid(), SIGKILL);
        return poses_.load_pose(p);
    }

  private:
    const PoseSource& poses_;
    uint32_t fatal_;
};

void limit_files(rlim_t size_bytes) {
    ::signal(SIGXFSZ, SIG_DFL);
    const rlimit no_core{0, 0}, limit{size_bytes, size_bytes};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::setrlimit(RLIMIT_FSIZE, &limit);
}

void run(const std::vector<std::string>& arguments) {
    const ThreadLimit limit(2);  // one bakes, one reads ahead
    BakeOptions options;
    options.rays = static_cast<uint32_t>(std::stoul(arguments[2]));
    options.bands = static_cast<uint32_t>(std::stoul(arguments[3]));
    const std::string& event = arguments[4];
    const auto place = static_cast<uint32_t>(std::stoul(arguments[5]));
    const ObjSequence poses(find_obj_files({arguments[0]}, false));
    if (event == "writing") limit_files(place);
    bake_sequence(FatalPose(poses, event == "reading" ? place : kNever), options, "faces",
                  arguments[1], 0, poses.num_poses() - 1, [&](uint32_t p) {
                      if (event == "after" && p == place) ::kill(::getpid(), SIGKILL);
                  });
}

}  // namespace
}  // namespace paim

int main(int argc, char** argv) {
    if (argc != 7) return 1;
    paim::run({argv + 1, argv + argc});
    return 0;  // and so it has not been killed
}
