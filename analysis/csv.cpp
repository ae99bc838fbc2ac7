// Error curves as CSV.
#include "analysis/csv.h"

#include <fmt/format.h>

#include "analysis/csv_field.h"

namespace paim {

std::string curve_csv(const Curve& curve, const std::vector<NamedLight>& lights) {
    std::string csv = fmt::format(
        "light,{},all,theory_error [fraction],energy_error [fraction],visual_error [fraction],"
        "position_rms [scene units],position_worst [scene units],worst_vertex,worst_pose,"
        "transfer_error [fraction],size [bytes],decode [ms per pose]\n",
        curve.name);
    for (size_t light = 0; light < lights.size(); ++light) {
        for (const CurvePoint& point : curve.points) {
            const DistanceError& distance = point.distance;
            csv += fmt::format(
                "{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{},{:.9g},{},{:.4g}\n",
                csv_field(lights[light].name), point.value, point.all ? "yes" : "no",
                point.theory_error, point.energy_error, point.visual_error[light], distance.rms(),
                distance.worst, distance.worst_vertex, distance.worst_pose,
                point.transfer.relative(), point.size_bytes, point.decode_ms);
        }
    }
    return csv;
}

}  // namespace paim
