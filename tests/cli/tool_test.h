// What the tests of the tools share: running them, small sequences, and what a folder holds.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "paim/base/file.h"
#include "tests/cli/run_tool.h"
#include "tests/temporary_directory.h"

namespace paim {

using Arguments = std::vector<std::string>;

// Path below the folder → bytes; a folder within is "NAME/" and no bytes.
using Contents = std::map<std::string, std::vector<char>>;

inline Contents contents_of(const std::filesystem::path& folder) {
    Contents contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder).string();
        if (entry.is_directory()) {
            contents[name + "/"] = {};
        } else {
            contents[name] = read_file(entry.path(), uint64_t{1} << 30);
        }
    }
    return contents;
}

inline std::vector<std::string> names_of(const Contents& contents) {
    std::vector<std::string> names;
    for (const auto& [name, bytes] : contents) names.push_back(name);
    return names;
}

// The same names and bytes; says which file differs instead of printing bytes.
inline void expect_same(const Contents& a, const Contents& b) {
    ASSERT_EQ(names_of(a), names_of(b));
    for (const auto& [name, bytes] : a) EXPECT_TRUE(bytes == b.at(name)) << name << " differs";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// One object and nothing else.
inline nlohmann::json parse_object(const ToolResult& result) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out, nullptr, false);
    EXPECT_TRUE(json.is_object()) << result.out;
    return json.is_object() ? json : nlohmann::json::object();
}

// A tool that runs while the test goes on; what it says is thrown away.
class BackgroundTool {
  public:
    explicit BackgroundTool(const Arguments& arguments) {
        std::vector<char*> argv;
        for (const std::string& argument : arguments) {
            argv.push_back(const_cast<char*>(argument.c_str()));
        }
        argv.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        for (const int fd : {STDOUT_FILENO, STDERR_FILENO}) {
            posix_spawn_file_actions_addopen(&actions, fd, "/dev/null", O_WRONLY, 0);
        }
        const int failure =
            ::posix_spawn(&child_, argv[0], &actions, nullptr, argv.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failure != 0) throw std::runtime_error(arguments[0] + ": " + std::strerror(failure));
    }
    ~BackgroundTool() {
        if (child_ == 0) return;
        kill();
        wait();
    }
    BackgroundTool(const BackgroundTool&) = delete;
    BackgroundTool& operator=(const BackgroundTool&) = delete;

    void kill() const { ::kill(child_, SIGKILL); }

    // The exit code, -N if signal N ended it.
    int wait() {
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = 0;
        return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
    }

  private:
    pid_t child_ = 0;
};

class ToolTest : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (directory_ / name).string(); }

    static ToolResult run(const char* tool, Arguments arguments) {
        arguments.insert(arguments.begin(), tool);
        return run_tool(arguments);
    }
    static ToolResult compress(const Arguments& a) { return run(PAIM_COMPRESS, a); }
    static ToolResult info(const Arguments& a) { return run(PAIM_INFO, a); }
    static ToolResult analyze(const Arguments& a) { return run(PAIM_ANALYZE, a); }

    static void expect_success(const ToolResult& result) {
        ASSERT_EQ(result.exit_code, 0) << result.err;
    }

    // The exit code, and a message with all these parts and nothing on standard output.
    static void expect_failure(const ToolResult& result, int exit_code, const Arguments& parts) {
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        EXPECT_EQ(result.out, "");
        for (const std::string& part : parts) {
            EXPECT_TRUE(contains(result.err, part)) << "no '" << part << "' in: " << result.err;
        }
    }

    // Poses of a shape of paim-poses as OBJ files in the folder of that name.
    std::string make_poses(const std::string& shape, uint32_t num_poses, uint32_t num_vertices) {
        const std::string folder = path(shape);
        expect_success(run(PAIM_POSES, {shape, "-o", folder, "--poses", std::to_string(num_poses),
                                        "--vertices", std::to_string(num_vertices)}));
        return folder;
    }

    // Four poses of two facing plates, 16 rays, 3 bands: quick, and every pose has its own
    // transfer.
    std::string make_bake(const std::string& name) {
        const std::string bake = path(name);
        expect_success(compress(
            {"bake", make_poses("plates", 4, 60), "-o", bake, "--rays", "16", "--bands", "3"}));
        return bake;
    }

    void write(const std::string& name, const std::string& text) const {
        write_file(directory_ / name, text);
    }

    std::string text_of(const std::string& name) const {
        const auto bytes = read_file(directory_ / name, 1 << 24);
        return {bytes.begin(), bytes.end()};
    }

    // Lines of fields of a CSV file without commas in its fields.
    std::vector<Arguments> read_csv(const std::string& name) const {
        std::istringstream text(text_of(name));
        std::vector<Arguments> rows;
        for (std::string line; std::getline(text, line);) {
            std::istringstream fields(line);
            rows.emplace_back();
            for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
        }
        return rows;
    }

    // That the page of an analysis names files of its folder that are there, and all of them but itself.
    void expect_page_names_all(const std::string& folder) const {
        const std::string html = text_of(folder + "/index.html");
        const std::regex reference("(?:src|href)=\"([^\"]*)\"");
        std::set<std::string> named{"index.html", "images/"};
        for (std::sregex_iterator match(html.begin(), html.end(), reference), end; match != end;
             ++match) {
            named.insert((*match)[1]);
        }
        const Arguments names = names_of(contents_of(path(folder)));
        EXPECT_EQ(named, std::set<std::string>(names.begin(), names.end()));
    }

    // That the error of a budget under a light is at most the sum of its causes, and at least the
    // largest of them.
    static void expect_causes_add_up(const nlohmann::json& of_light) {
        double sum = 0.0, largest = 0.0;
        for (const auto& [cause, entry] : of_light.items()) {
            if (cause == "all" || !entry.is_object()) continue;
            sum += entry["visual_error"].get<double>();
            largest = std::max(largest, entry["visual_error"].get<double>());
        }
        const double all = of_light["all"]["visual_error"];
        EXPECT_LE(all, sum);
        EXPECT_GE(all, largest);
    }

    TemporaryDirectory directory_;
};

}  // namespace paim
