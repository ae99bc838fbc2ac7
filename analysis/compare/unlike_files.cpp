// How unlike several .paim files are, where no truth is known.
#include "analysis/compare/unlike_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "analysis/compare/played_pictures.h"
#include "analysis/frame_time.h"
#include "paim/base/error.h"
#include "paim/format/paim/paim_read.h"
#include "paim/image/tone.h"
#include "paim/metrics/asset_error.h"
#include "paim/metrics/image_error.h"

namespace paim {

namespace {

using AssetPointer = std::shared_ptr<const Asset>;

// Files that were not measured state no errors.
void add_stated_errors(const Asset& asset, UnlikeFile& file) {
    file.stated_transfer_error = file.stated_position_error =
        std::numeric_limits<double>::quiet_NaN();
    const auto provenance = nlohmann::json::parse(asset.provenance_json, nullptr, false);
    if (!provenance.is_object() || !provenance.contains("measured")) return;
    for (const NamedError& error : read_error_statement(asset, file.path).errors) {
        if (error.name == "transfer_total_error") file.stated_transfer_error = error.value;
        if (error.name == "position_relative_rms") file.stated_position_error = error.value;
    }
}

std::vector<AssetPointer> read_files(const std::vector<std::filesystem::path>& paths) {
    std::vector<AssetPointer> assets;
    for (const std::filesystem::path& path : paths) {
        assets.push_back(std::make_shared<const Asset>(read_paim(path)));
        const uint32_t expected = assets.front()->num_poses(), got = assets.back()->num_poses();
        if (got == expected) continue;
        throw_bad_input(
            "{}: expected the {} poses of {}, got {}: files of one sequence are compared",
            path.string(), expected, paths.front().string(), got);
    }
    return assets;
}

uint32_t num_poses_shown(const StageOptions& options, uint32_t num_poses) {
    return std::min(options.num_poses, num_poses);
}

// Of a file under a light, then of their pictures.
std::vector<Column> row_of(const UnlikeFile& file, const PictureErrors& difference) {
    const PictureErrors::Spread spread = difference.spread();
    return {{"codec", "", file.codec},
            {"bands", "", file.bands},
            {"geometry_components", "", file.geometry_components},
            {"transfer_components", "", file.transfer_components},
            {"size", "bytes", file.size_bytes},
            {"rate", "bits per vertex and pose", file.bits_per_vertex_per_pose},
            {"multiply_adds", "per vertex and frame", file.multiply_adds},
            {"position_multiply_adds", "per vertex and frame", file.position_multiply_adds},
            {"cpu_multiply_adds", "per frame", file.cpu_multiply_adds},
            {"stated_transfer_total_error", "fraction", file.stated_transfer_error},
            {"stated_position_relative_rms", "of the diagonal", file.stated_position_error},
            {"difference", "fraction", difference.visual_error()},
            {"difference_least", "fraction", spread.least},
            {"difference_most", "fraction", spread.most},
            {"worst_picture_pose", "", spread.worst_pose},
            {"worst_picture_view", "", spread.worst_view},
            {"frame", "ms", file.frame.median_ms}};
}

std::string stated_text(double error) {
    return std::isnan(error) ? "not stated" : percent_text(error);
}

PageTable table_of(const std::vector<UnlikeFile>& files, const std::vector<NamedLight>& lights) {
    PageTable table;
    const auto add = [&](std::string heading, const auto& text) {
        std::vector<std::string>& row = table.emplace_back();
        row.push_back(std::move(heading));
        for (const UnlikeFile& file : files) row.push_back(text(file));
    };
    add("", [](const UnlikeFile& f) { return f.path.filename().string(); });
    add("codec", [](const UnlikeFile& f) { return f.codec; });
    add("bands", [](const UnlikeFile& f) { return std::to_string(f.bands); });
    add("components of geometry, transfer", [](const UnlikeFile& f) {
        return fmt::format("{}, {}", f.geometry_components, f.transfer_components);
    });
    add("bytes", [](const UnlikeFile& f) { return std::to_string(f.size_bytes); });
    add("bits per vertex and pose",
        [](const UnlikeFile& f) { return fmt::format("{:.3g}", f.bits_per_vertex_per_pose); });
    add("multiply-adds per vertex and frame: lit transfer, positions", [](const UnlikeFile& f) {
        return fmt::format("{}, {}", f.multiply_adds, f.position_multiply_adds);
    });
    add("ms to decode and light a frame",
        [](const UnlikeFile& f) { return fmt::format("{:.3g}", f.frame.median_ms); });
    add("transfer error, as the file states it",
        [](const UnlikeFile& f) { return stated_text(f.stated_transfer_error); });
    add("RMS distance by the diagonal, as the file states it",
        [](const UnlikeFile& f) { return stated_text(f.stated_position_error); });
    for (size_t light = 0; light < lights.size(); ++light) {
        add("difference from the first file, " + lights[light].name,
            [&](const UnlikeFile& f) { return percent_text(f.differences[light].visual_error()); });
        add("most of one picture, " + lights[light].name, [&](const UnlikeFile& f) {
            const PictureErrors::Spread spread = f.differences[light].spread();
            return fmt::format("{} (pose {})", percent_text(spread.most), spread.worst_pose);
        });
    }
    return table;
}

void add_strips(Page& page, const std::vector<UnlikeFile>& files, const std::string& light,
                size_t number) {
    const Image& first = files.front().images[number];
    const ToneCurve tone{suggested_exposure_ev(first), 0.0f};
    page.add_paragraph(fmt::format("Light: {}, shown at {:+.1f} EV.", light, tone.exposure_ev));
    std::vector<Page::Picture> pictures, differences{{"", "difference, times four", nullptr}};
    std::vector<Image> images;  // that `differences` point to
    images.reserve(files.size());
    for (size_t j = 0; j < files.size(); ++j) {
        const Image& image = files[j].images[number];
        const std::string stem = fmt::format("images/played_{}_{}", number, j);
        pictures.push_back({stem + ".png", files[j].path.filename().string(), &image});
        if (j == 0) continue;
        images.push_back(difference_image(image, first));
        differences.push_back({stem + "_difference.png",
                               percent_text(files[j].differences[number].visual_error()),
                               &images.back()});
    }
    page.add_pictures(pictures, tone);
    page.add_pictures(differences, tone);
}

}  // namespace

size_t unlike_steps(size_t num_files, const StageOptions& options) {
    return num_files * (1 + options.num_poses);
}

std::vector<UnlikeFile> compare_played(const std::vector<std::filesystem::path>& paths,
                                       const std::vector<NamedLight>& lights,
                                       const StageOptions& options,
                                       const std::function<void()>& on_step) {
    const std::vector<AssetPointer> assets = read_files(paths);
    const PlayedViews views(*assets.front(), options);
    std::vector<UnlikeFile> files(paths.size());
    std::vector<PlayedPictures> players;
    for (size_t j = 0; j < paths.size(); ++j) {
        static_cast<FileCosts&>(files[j]) = costs_of(paths[j], *assets[j]);
        add_stated_errors(*assets[j], files[j]);
        files[j].differences.resize(lights.size());
        files[j].frame = time_frames(assets[j], lights.front().coefficients, kQuickSeconds);
        players.emplace_back(assets[j], views, lights);
        on_step();
    }
    const uint32_t num_poses = assets.front()->num_poses();
    const uint32_t count = num_poses_shown(options, num_poses);
    for (uint32_t n = 0; n < count; ++n) {
        const auto p = static_cast<uint32_t>(uint64_t{n} * num_poses / count);
        std::vector<Image> first;
        for (size_t j = 0; j < files.size(); ++j) {
            std::vector<Image> pictures = players[j].at(p);
            if (j == 0) first = pictures;
            for (size_t k = 0; k < pictures.size(); ++k) {
                files[j].differences[k % lights.size()].add(compare_images(pictures[k], first[k]),
                                                            p, k / lights.size());
            }
            if (n == 0) {
                pictures.resize(lights.size());
                files[j].images = std::move(pictures);
            }
            on_step();
        }
    }
    return files;
}

std::string unlike_csv(const std::vector<UnlikeFile>& files,
                       const std::vector<NamedLight>& lights) {
    std::string csv;
    for (size_t light = 0; light < lights.size(); ++light) {
        for (const UnlikeFile& file : files) {
            std::vector<Column> row{{"light", "", lights[light].name},
                                    {"file", "", file.path.string()}};
            const std::vector<Column> of_file = row_of(file, file.differences[light]);
            row.insert(row.end(), of_file.begin(), of_file.end());
            if (csv.empty()) csv = csv_line(row, heading_field);
            csv += csv_line(row, value_field);
        }
    }
    return csv;
}

nlohmann::ordered_json unlike_json(const std::vector<UnlikeFile>& files,
                                   const std::vector<NamedLight>& lights) {
    auto all = nlohmann::ordered_json::array();
    for (const UnlikeFile& file : files) {
        nlohmann::ordered_json json{{"file", file.path.string()}};
        for (size_t light = 0; light < lights.size(); ++light) {
            for (const Column& column : row_of(file, file.differences[light])) {
                const bool is_of_light = column.name.starts_with("difference") ||
                                         column.name.starts_with("worst_picture");
                (is_of_light ? json["lights"][lights[light].name] : json)[column.name] =
                    column.value;
            }
        }
        all.push_back(std::move(json));
    }
    return all;
}

void add_unlike(Page& page, const std::vector<UnlikeFile>& files,
                const std::vector<NamedLight>& lights) {
    page.add_paragraph(
        "No truth is known: without the bake, a difference says how unlike a file is to the first one, "
        "not which of them is right. Differences are Σ |I − I_first| / Σ |I_first| over all pictures.");
    page.add_table(table_of(files, lights));
    for (size_t light = 0; light < lights.size(); ++light) {
        add_strips(page, files, lights[light].name, light);
    }
    page.add_link("compare.csv");
}

}  // namespace paim
