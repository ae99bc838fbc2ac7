// Runs gnuplot.
#include "analysis/gnuplot.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>

#include "paim/base/error.h"

namespace paim {

bool have_gnuplot() {
    return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

void run_gnuplot(const std::string& script, const std::filesystem::path& output) {
    std::FILE* pipe = ::popen("gnuplot", "w");
    if (pipe == nullptr) throw_output_failed("{}: cannot start gnuplot", output.string());
    const bool written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
    const int status = ::pclose(pipe);
    if (!written || status != 0 || !std::filesystem::exists(output)) {
        throw_output_failed("{}: gnuplot failed (status {})", output.string(), status);
    }
}

std::string gnuplot_text(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'') result += '\'';
        result += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
    }
    return result + "'";
}

std::string gnuplot_begin(const std::filesystem::path& output, const std::string& title) {
    return fmt::format(
        "set terminal svg size 640,420 noenhanced font 'sans,13' background 'white'\n"
        // Instead of yellow, which can hardly be seen on white.
        "set linetype 5 lc rgb '#7f4f24'\n"
        "set output {}\nset title {} noenhanced\n",
        gnuplot_text(output.string()), gnuplot_text(title));
}

}  // namespace paim
