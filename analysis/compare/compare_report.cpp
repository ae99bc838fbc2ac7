// Compared files as CSV, JSON and a section of the page.
#include "analysis/compare/compare_report.h"

#include <fmt/format.h>

#include "analysis/csv_field.h"

namespace paim {

std::string compare_csv(const FileComparison& comparison, const std::vector<NamedLight>& lights) {
    std::string csv =
        "light,file,codec,bands,geometry_components,transfer_components,size [bytes],"
        "rate [bits per vertex and pose],multiply_adds [per vertex and frame],"
        "position_multiply_adds [per vertex and frame],cpu_multiply_adds [per frame],"
        "visual_error [fraction],visual_error_least [fraction],visual_error_most [fraction],"
        "worst_picture_pose,worst_picture_view,reference_noise [fraction],psnr [dB],"
        "flicker [fraction of change],flicker [fraction of radiance],worst_step";
    for (const NamedError& error : named_errors(comparison.files.front().error)) {
        csv += "," + error.name;
    }
    csv +=
        ",worst_transfer_vertex,worst_transfer_pose,worst_position_vertex,worst_position_pose,"
        "frame [ms]\n";
    for (size_t light = 0; light < lights.size(); ++light) {
        for (const ComparedFile& file : comparison.files) {
            const PictureErrors& seen = file.seen[light];
            const PictureErrors::Spread spread = seen.spread();
            const Flicker& flicker = file.flicker[light];
            csv += fmt::format(
                "{},{},{},{},{},{},{},{:.9g},{},{},{},", csv_field(lights[light].name),
                csv_field(file.path.string()), file.codec, file.bands, file.geometry_components,
                file.transfer_components, file.size_bytes, file.bits_per_vertex_per_pose,
                file.multiply_adds, file.position_multiply_adds, file.cpu_multiply_adds);
            csv += fmt::format("{:.9g},{:.9g},{:.9g},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{}",
                               seen.visual_error(), spread.least, spread.most, spread.worst_pose,
                               spread.worst_view, comparison.reference_noise[light],
                               seen.all().psnr_db(), flicker.of_change(), flicker.of_radiance(),
                               flicker.worst_step);
            for (const NamedError& error : named_errors(file.error)) {
                csv += fmt::format(",{:.9g}", error.value);
            }
            const DistanceError& distance = file.error.geometry.distance;
            csv += fmt::format(",{},{},{},{},{:.4g}\n", file.error.transfer.worst_vertex,
                               file.error.transfer.worst_pose, distance.worst_vertex,
                               distance.worst_pose, file.frame.median_ms);
        }
    }
    return csv;
}

nlohmann::ordered_json compare_json(const FileComparison& comparison,
                                    const std::vector<NamedLight>& lights) {
    auto files = nlohmann::ordered_json::array();
    for (const ComparedFile& file : comparison.files) {
        nlohmann::ordered_json json{{"file", file.path.string()},
                                    {"codec", file.codec},
                                    {"bands", file.bands},
                                    {"geometry_components", file.geometry_components},
                                    {"transfer_components", file.transfer_components},
                                    {"size_bytes", file.size_bytes},
                                    {"bits_per_vertex_per_pose", file.bits_per_vertex_per_pose},
                                    {"multiply_adds", file.multiply_adds},
                                    {"position_multiply_adds", file.position_multiply_adds},
                                    {"cpu_multiply_adds", file.cpu_multiply_adds}};
        for (size_t light = 0; light < lights.size(); ++light) {
            const PictureErrors& seen = file.seen[light];
            const PictureErrors::Spread spread = seen.spread();
            const Flicker& flicker = file.flicker[light];
            json["lights"][lights[light].name] = {
                {"visual_error", seen.visual_error()},
                {"least", spread.least},
                {"most", spread.most},
                {"worst_pose", spread.worst_pose},
                {"worst_view", spread.worst_view},
                {"reference_noise", comparison.reference_noise[light]},
                {"psnr_db", seen.all().psnr_db()},
                {"flicker_of_change", flicker.of_change()},
                {"flicker_of_radiance", flicker.of_radiance()},
                {"worst_step", flicker.worst_step}};
        }
        for (const NamedError& error : named_errors(file.error)) {
            json["errors"][error.name] = error.value;
        }
        json["worst"] = {{"transfer_vertex", file.error.transfer.worst_vertex},
                         {"transfer_pose", file.error.transfer.worst_pose},
                         {"position_vertex", file.error.geometry.distance.worst_vertex},
                         {"position_pose", file.error.geometry.distance.worst_pose}};
        json["frame_ms"] = file.frame.median_ms;
        files.push_back(std::move(json));
    }
    return files;
}

namespace {

// A row of the table: its heading, and its text for each file.
template <typename Text>
std::vector<std::string> row_of(const FileComparison& comparison, std::string heading,
                                const Text& text) {
    std::vector<std::string> row{std::move(heading)};
    for (const ComparedFile& file : comparison.files) row.push_back(text(file));
    return row;
}

PageTable table_of(const FileComparison& comparison, const std::vector<NamedLight>& lights) {
    PageTable table;
    const auto add = [&](const std::string& heading, const auto& text) {
        table.push_back(row_of(comparison, heading, text));
    };
    using File = ComparedFile;
    add("", [](const File& f) { return f.path.filename().string(); });
    add("codec", [](const File& f) { return f.codec; });
    add("bands", [](const File& f) { return std::to_string(f.bands); });
    add("components of geometry, transfer", [](const File& f) {
        return fmt::format("{}, {}", f.geometry_components, f.transfer_components);
    });
    add("bytes", [](const File& f) { return std::to_string(f.size_bytes); });
    add("bits per vertex and pose",
        [](const File& f) { return fmt::format("{:.3g}", f.bits_per_vertex_per_pose); });
    add("multiply-adds per vertex and frame: lit transfer, positions", [](const File& f) {
        return fmt::format("{}, {}", f.multiply_adds, f.position_multiply_adds);
    });
    add("ms to decode and light a frame",
        [](const File& f) { return fmt::format("{:.3g}", f.frame.median_ms); });
    for (size_t light = 0; light < lights.size(); ++light) {
        const std::string& name = lights[light].name;
        add("seen (E6), " + name,
            [&](const File& f) { return percent_text(f.seen[light].visual_error()); });
        add("most of one picture, " + name, [&](const File& f) {
            const PictureErrors::Spread spread = f.seen[light].spread();
            return fmt::format("{} (pose {})", percent_text(spread.most), spread.worst_pose);
        });
        add("flicker of the change, of the radiance, " + name, [&](const File& f) {
            return fmt::format("{}, {}", percent_text(f.flicker[light].of_change()),
                               percent_text(f.flicker[light].of_radiance()));
        });
    }
    add("worst vertex of the transfer (pose)", [](const File& f) {
        return fmt::format("{} ({})", f.error.transfer.worst_vertex, f.error.transfer.worst_pose);
    });
    add("worst vertex of positions (pose)", [](const File& f) {
        return fmt::format("{} ({})", f.error.geometry.distance.worst_vertex,
                           f.error.geometry.distance.worst_pose);
    });
    const std::vector<NamedError> names = named_errors(comparison.files.front().error);
    for (size_t n = 0; n < names.size(); ++n) {
        add(names[n].name,
            [&](const File& f) { return fmt::format("{:.4g}", named_errors(f.error)[n].value); });
    }
    return table;
}

void add_light(Page& page, const FileComparison& comparison, const Stage& stage, size_t light,
               const std::string& reference_name) {
    const Image& reference = comparison.reference[light];
    const ToneCurve tone{suggested_exposure_ev(reference), 0.0f};
    page.add_paragraph(fmt::format(
        "Light: {}, shown at {:+.1f} EV. Second row: difference from the reference, and "
        "then of the first file from the others, times four.",
        stage.lights()[light].name, tone.exposure_ev));
    std::vector<Page::Picture> pictures{
        {fmt::format("images/compared_{}_reference.png", light), reference_name, &reference}};
    std::vector<Page::Picture> differences{{"", "difference, times four", nullptr}};
    std::vector<Image> images;  // pictures point to them
    images.reserve(2 * comparison.files.size());
    const auto add_difference = [&](const std::string& stem, const std::string& caption,
                                    const Image& a, const Image& b) {
        images.push_back(difference_image(a, b));
        differences.push_back({"images/" + stem + ".png", caption, &images.back()});
    };
    for (size_t j = 0; j < comparison.files.size(); ++j) {
        const ComparedFile& file = comparison.files[j];
        const std::string stem = fmt::format("compared_{}_{}", light, j);
        pictures.push_back(
            {"images/" + stem + ".png", file.path.filename().string(), &file.images[light]});
        add_difference(stem + "_difference", percent_text(file.seen[light].visual_error()),
                       file.images[light], reference);
    }
    for (size_t j = 1; j < comparison.files.size(); ++j) {
        add_difference(fmt::format("compared_{}_0_{}", light, j),
                       comparison.files.front().path.filename().string() + " from " +
                           comparison.files[j].path.filename().string(),
                       comparison.files.front().images[light], comparison.files[j].images[light]);
    }
    page.add_pictures(pictures, tone);
    page.add_pictures(differences, tone);
}

}  // namespace

void add_comparison(Page& page, const FileComparison& comparison, const Stage& stage,
                    const std::string& reference_name) {
    page.add_heading("Files side by side");
    page.add_paragraph("Pictures are compared with " + reference_name + ".");
    page.add_table(table_of(comparison, stage.lights()));
    for (size_t light = 0; light < stage.lights().size(); ++light) {
        add_light(page, comparison, stage, light, reference_name);
    }
    page.add_link("compare.csv");
}

}  // namespace paim
