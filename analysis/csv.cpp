// Tables as CSV.
#include "analysis/csv.h"

#include <fmt/format.h>

#include "analysis/csv_field.h"

namespace paim {

std::string curve_csv(const Curve& curve, const std::vector<NamedLight>& lights,
                      const std::vector<double>& reference_noise) {
    std::string csv = fmt::format(
        "light,{},all,theory_error [fraction],energy_error [fraction],visual_error [fraction],"
        "visual_error_least [fraction],visual_error_median [fraction],visual_error_most [fraction],"
        "visual_error_deviation [fraction],worst_picture_pose,worst_picture_view,"
        "reference_noise [fraction],rmse [radiance],psnr [dB],"
        "position_rms [scene units],position_worst [scene units],worst_vertex,worst_pose,"
        "edge_distortion [fraction],normal_angle [degrees],transfer_error [fraction],"
        "size [bytes],decode [ms per pose]\n",
        curve.name);
    for (size_t light = 0; light < lights.size(); ++light) {
        for (const CurvePoint& point : curve.points) {
            const DistanceError& distance = point.distance;
            const PictureErrors& seen = point.seen[light];
            const PictureErrors::Spread spread = seen.spread();
            csv += fmt::format("{},{},{},{:.9g},{:.9g},{:.9g},", csv_field(lights[light].name),
                               point.value, point.all ? "yes" : "no", point.theory_error,
                               point.energy_error, seen.visual_error());
            csv += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{},{},{:.9g},{:.9g},{:.9g},",
                               spread.least, spread.median, spread.most, spread.deviation,
                               spread.worst_pose, spread.worst_view, reference_noise[light],
                               seen.all().rmse(), seen.all().psnr_db());
            csv +=
                fmt::format("{:.9g},{:.9g},{},{},{:.9g},{:.9g},{:.9g},{},{:.4g}\n", distance.rms(),
                            distance.worst, distance.worst_vertex, distance.worst_pose,
                            point.shape.sted_space, point.shape.normal_angle_deg,
                            point.transfer.relative(), point.size_bytes, point.decode.median_ms);
        }
    }
    return csv;
}

}  // namespace paim
