// The error budget as CSV, JSON, chart and section of the page.
#include "analysis/budget/budget_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/csv_field.h"
#include "analysis/gnuplot.h"

namespace paim {

std::string budget_csv(const ErrorBudget& budget, const std::vector<NamedLight>& lights) {
    std::string csv =
        "light,cause,visual_error [fraction],visual_error_least [fraction],"
        "visual_error_median [fraction],visual_error_most [fraction],rmse [radiance],psnr [dB]\n";
    const auto add_line = [&](const NamedLight& light, const char* cause,
                              const PictureErrors& errors) {
        const PictureErrors::Spread spread = errors.spread();
        csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                           csv_field(light.name), cause, errors.visual_error(), spread.least,
                           spread.median, spread.most, errors.all().rmse(), errors.all().psnr_db());
    };
    for (size_t light = 0; light < lights.size(); ++light) {
        for (const BudgetTerm& term : budget.terms) {
            add_line(lights[light], term.name, term.errors[light]);
        }
        add_line(lights[light], "all", budget.whole[light]);
    }
    return csv;
}

nlohmann::ordered_json budget_json(const ErrorBudget& budget,
                                   const std::vector<NamedLight>& lights) {
    nlohmann::ordered_json json;
    json["transfer_rays"] = budget.transfer_rays;
    const auto errors_json = [](const PictureErrors& errors) {
        const PictureErrors::Spread spread = errors.spread();
        return nlohmann::ordered_json{{"visual_error", errors.visual_error()},
                                      {"least", spread.least},
                                      {"median", spread.median},
                                      {"most", spread.most},
                                      {"rmse", errors.all().rmse()},
                                      {"psnr_db", errors.all().psnr_db()}};
    };
    for (size_t light = 0; light < lights.size(); ++light) {
        nlohmann::ordered_json& entry = json["lights"][lights[light].name];
        for (const BudgetTerm& term : budget.terms) {
            entry[term.name] = errors_json(term.errors[light]);
        }
        entry["all"] = errors_json(budget.whole[light]);
        entry["pixel_noise"] = budget.pixel_noise[light];
        entry["vertex_noise"] = budget.vertex_noise[light];
    }
    return json;
}

void write_budget_plot(const std::filesystem::path& output, const ErrorBudget& budget,
                       const std::vector<NamedLight>& lights) {
    const auto is_seen = [](const PictureErrors& errors) {
        return std::isfinite(errors.visual_error());
    };
    if (std::none_of(budget.whole.begin(), budget.whole.end(), is_seen)) {
        std::error_code ignored;  // an older chart would be shown instead
        std::filesystem::remove(output, ignored);
        return;
    }
    const auto percent = [&](const PictureErrors& errors) {
        return is_seen(errors) ? 100.0 * errors.visual_error() : 0.0;
    };
    std::string script = gnuplot_begin(output, "Error budget");
    script +=
        "set terminal svg size 760,420 noenhanced font 'sans,13' background 'white'\n"
        "set ylabel 'visual error, percent'\nset yrange [0:*]\nset grid y\n"
        "set style data histograms\nset style histogram rowstacked\nset boxwidth 0.5\n"
        "set style fill solid 0.85 border -1\nset key outside right top reverse Left invert\n"
        "$data << EOD\n";
    for (size_t light = 0; light < lights.size(); ++light) {
        // A double quote would end the name.
        std::string name = gnuplot_text(lights[light].name);
        for (char& c : name) c = c == '"' ? '\'' : c;
        script += '"' + name.substr(1, name.size() - 2) + '"';
        for (const BudgetTerm& term : budget.terms) {
            script += fmt::format(" {:.9g}", percent(term.errors[light]));
        }
        script += fmt::format(" {:.9g}\n", percent(budget.whole[light]));
    }
    script += "EOD\nplot ";
    size_t column = 2;
    for (const BudgetTerm& term : budget.terms) {
        script += fmt::format("$data using {}{} title {}, ", column, column == 2 ? ":xtic(1)" : "",
                              gnuplot_text(term.name));
        ++column;
    }
    script += fmt::format(
        "$data using 0:{} with points pt 7 ps 1.2 lc 'black' title 'all together'\n", column);
    run_gnuplot(script, output);
}

std::string budget_answer(const std::string& file, const ErrorBudget& budget,
                          const std::vector<NamedLight>& lights) {
    std::string text = file + " against traced pictures: ";
    for (size_t light = 0; light < lights.size(); ++light) {
        const auto largest = std::max_element(
            budget.terms.begin(), budget.terms.end(), [&](const auto& a, const auto& b) {
                return a.errors[light].visual_error() < b.errors[light].visual_error();
            });
        text += fmt::format("{}{} {} (most from {}, {})", light > 0 ? "; " : "", lights[light].name,
                            percent_text(budget.whole[light].visual_error()), largest->name,
                            percent_text(largest->errors[light].visual_error()));
    }
    return text;
}

void add_budget(Page& page, const std::string& file, const ErrorBudget& budget,
                const Stage& stage) {
    page.add_heading("Error budget of " + file);
    page.add_paragraph(
        "Each cause of error is switched on after those above it, from pictures that are traced at "
        "every pixel to the file as it is played. Errors are what the cause changes, relative to "
        "the traced pictures. Causes partly cancel, so that the file's error, which is the dot in the chart, "
        "is at most the height of the bar.");
    page.add_plots({"budget.svg"});
    PageTable table(1);
    table[0] = {"cause"};
    for (const NamedLight& light : stage.lights()) {
        table[0].push_back("seen, " + light.name);
        table[0].emplace_back("least … most");
    }
    table[0].emplace_back("smaller with");
    table[0].emplace_back("what it is");
    const auto add_row = [&](const char* name, const char* meaning, const char* cure,
                             const std::vector<PictureErrors>& errors) {
        std::vector<std::string> row{name};
        for (const PictureErrors& seen : errors) {
            const PictureErrors::Spread spread = seen.spread();
            row.push_back(percent_text(seen.visual_error()));
            row.push_back(
                fmt::format("{:.2g} … {:.2g}", 100.0 * spread.least, 100.0 * spread.most));
        }
        row.emplace_back(cure);
        row.emplace_back(meaning);
        table.push_back(std::move(row));
    };
    for (const BudgetTerm& term : budget.terms)
        add_row(term.name, term.meaning, term.cure, term.errors);
    add_row("all together", "the file against the traced pictures", "", budget.whole);
    page.add_table(table);
    page.add_paragraph(
        fmt::format("The transfer that bands and noise are told apart by was baked with {} rays.",
                    budget.transfer_rays));
    for (size_t light = 0; light < stage.lights().size(); ++light) {
        page.add_paragraph(fmt::format(
            "Light: {}. Noise of the traced pictures: {:.2g} % at pixels, {:.2g} % at vertices. It is part of "
            "interpolation, bands and the whole. First row: traced, then with each cause. Second row: what the "
            "cause changes, times four.",
            stage.lights()[light].name, 100.0 * budget.pixel_noise[light],
            100.0 * budget.vertex_noise[light]));
        const ToneCurve tone{suggested_exposure_ev(budget.truth[light]), 0.0f};
        std::vector<Page::Picture> pictures{
            {fmt::format("images/budget_{}_truth.png", light), "traced", &budget.truth[light]}};
        std::vector<Image> changes;
        changes.reserve(budget.terms.size());  // pictures point to them
        std::vector<Page::Picture> differences{{"", "change, times four", nullptr}};
        const Image* before = &budget.truth[light];
        for (size_t n = 0; n < budget.terms.size(); ++n) {
            const BudgetTerm& term = budget.terms[n];
            const Image& image = term.pictures[light];
            pictures.push_back(
                {fmt::format("images/budget_{}_{}.png", light, n), term.name, &image});
            changes.push_back(difference_image(image, *before));
            differences.push_back({fmt::format("images/budget_{}_{}_change.png", light, n),
                                   percent_text(term.errors[light].visual_error()),
                                   &changes.back()});
            before = &image;
        }
        page.add_pictures(pictures, tone);
        page.add_pictures(differences, tone);
    }
    page.add_link("budget.csv");
}

}  // namespace paim
