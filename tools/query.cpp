// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "commands.h"
#include "errors.h"
#include "line_reader.h"
#include "query_answer.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

namespace regain::tools {
namespace {

constexpr std::size_t longest_line = 1 << 20, output_chunk = 1 << 16;

constexpr const char* help_footer = R"help(
Each line of input is an object, each line of output its answer, in the same order. A line that
cannot be answered gives {"error": "..."}, and the run goes on; the exit code is then 2. Blank
lines are skipped. Answers come as soon as no further input is waiting, so a program can hold a
conversation through two pipes.

fields of a line
  op          eval, pdf, sample, albedo, gain, fresnel, ndf
  closure     conductor, generalized_schlick, dielectric, sheen,
              oren_nayar_diffuse, burley_diffuse, subsurface (a diffuse stand-in),
              translucent, transparent; or of closures, each an object:
              layer (top, base), mix (fg, bg, mix), add (in1, in2),
              multiply (in1, in2: a number or a colour)
  distribution  ggx (default), beckmann, gtr, std
  gamma       of gtr, from 0.001 to 10, and std, from 1.51 to 100; default 2
  alpha       a number in [0, 1], or [alpha_x, alpha_y]; default 0.05
  fresnel     {"F0": [r,g,b], "F82": [r,g,b]} (F82 optional), {"n": [r,g,b], "k": [r,g,b]},
              {"constant": [r,g,b]}, or {"eta": x} of dielectric; instead of it, by MaterialX's names:
              ior and extinction of conductor (default: gold), color0, color82, color90 and exponent
              of generalized_schlick (default: 1, 1, 1, 5), ior of dielectric (1.5)
  scatter_mode  of dielectric: R, T, RT (default)
  transmission_shadowing  of dielectric: correlated (default), beta
  thin_walled   of dielectric: true for a sheet; tint: [r,g,b] of all that it scatters
  color       of what has no microfacets; default MaterialX's
  roughness, energy_compensation
              of oren_nayar_diffuse; roughness of burley_diffuse and sheen, too
  thinfilm_thickness, thinfilm_ior
              of conductor, generalized_schlick, dielectric: accepted, without effect, which the
              answer notes
  mode        of sheen: burley (default; takes weight), conty_kulla, zeltner
  method      none (default), normalise, turquin, turquin-eq12, turquin-eq13, turquin-eq14, series,
              directional, balanced, kulla-conty, kulla-conty-series, tail, walk, walk-bounded,
              burley-sheen; docs/support.md says what goes with what
  strength    of the method, in [0, 1]; default 1; 0 or 1 for walk, walk-bounded
  precision   float (default), double
  transport   importance (default), radiance: transmitted values and weights times the squared ratio
              of the indices on the sides of wo and wi
  wo          [x, y, z], a unit vector (length 1 within 0.001; used as given), z = normal; or
  mu          in [-1, 1], for wo = [sqrt(1 - mu^2), 0, mu]
  wi          eval, pdf; gain of balanced
  u           sample: [u1, u2], each in [0, 1), or [u1, u2, u3] where the closure reads three:
              dielectric, gtr, std, sheen and every method that is no gain; or
  n, seed     sample: n samples (up to 1000000) from the seed (default 0)
  u; n, seed  eval of walks, an estimate: [u1, u2, u3], or the mean of n (default 1024)
  how         albedo: quadrature (default), table, monte-carlo (with n, default 65536, and seed;
              the default of walk, of kulla-conty and tail on a dielectric, and of what is
              combined)
  order       albedo of walk: light of so many bounces alone
  mu          fresnel: in [0, 1]; below 0 from inside a dielectric
  wm          ndf: the microfacet normal, beside wo

answers
  eval     {"value":[r,g,b]}            f |cos theta_i|; of walk with "stderr":e
  pdf      {"pdf":p}
  sample   {"wi":[..],"weight":[r,g,b],"pdf":p,"event":"reflect","measure":"continuous"}, event
           "transmit" through a dielectric, measure "delta" for a mirror; {"event":"none"}; with n {"samples":[...]}
  albedo   {"reflect":[r,g,b],"transmit":[r,g,b],"stderr":e,"how":".."}; stderr is the difference
           from a coarser quadrature, the standard error of Monte Carlo, or null
  gain     {"gain":[r,g,b],"form":"gain(wo)"}; with an added lobe the albedo over that without it
  fresnel  {"value":[r,g,b],"average":[r,g,b]}
  ndf      {"D":..,"lambda":..,"G1":..,"D_visible":..}
  "note" is added where something is left out or stood in for

Random numbers from a seed are SplitMix64's, two or three for a sample: the upper 24 bits of a draw over
2^24 in float, the upper 53 over 2^53 in double.

examples:
  echo '{"op":"eval","closure":"conductor","alpha":0.5,"mu":0.7,"wi":[0,0,1]}' | regain query
  echo '{"op":"albedo","closure":"conductor","alpha":1,"fresnel":{"constant":[1,1,1]},"mu":1}' |
    regain query                        # 1 - ln 2, what a rough mirror keeps
  echo '{"op":"sample","closure":"dielectric","alpha":0.3,"mu":-0.5,"n":3}' | regain query
  regain query questions.jsonl > answers.jsonl
)help";

class Input
{
public:
    explicit Input(const std::string& file) : _name(file == "-" ? "standard input" : file)
    {
        if (file == "-") return;
        _descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
        if (_descriptor < 0)
            throw BadInput(fmt::format("cannot read '{}': {}", file, std::strerror(errno)));
        _owned = true;
    }
    ~Input()
    {
        if (_owned) ::close(_descriptor);
    }
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    int descriptor() const { return _descriptor; }
    const std::string& name() const { return _name; }

private:
    std::string _name;
    int _descriptor = STDIN_FILENO;
    bool _owned = false;
};

void flush(fmt::memory_buffer& out)
{
    const bool written = std::fwrite(out.data(), 1, out.size(), stdout) == out.size();
    if (!written || std::fflush(stdout) != 0)
        throw BadInput(fmt::format("cannot write the answers: {}", std::strerror(errno)));
    out.clear();
}

int run(const std::string& file)
{
    const Input input(file);
    fmt::memory_buffer out;
    LineReader reader(input.descriptor(), longest_line, [&] { flush(out); });

    std::uint64_t lines = 0, bad = 0, first_bad = 0;
    const auto next = [&] {
        try
        {
            return reader.next();
        }
        catch (const BadInput&)
        {
            throw;
        }
        catch (const std::exception& e)
        {
            throw BadInput(fmt::format("cannot read '{}': {}", input.name(), e.what()));
        }
    };
    while (const auto line = next())
    {
        ++lines;
        bool answered = false;
        if (line->too_long)
            write_error(fmt::format("the line is longer than {} bytes", longest_line), out);
        else if (line->text.find_first_not_of(" \t\r") == std::string_view::npos)
            continue;
        else
            answered = answer_line(line->text, out);
        if (!answered && bad++ == 0) first_bad = lines;
        out.push_back('\n');
        if (out.size() > output_chunk) flush(out);
    }
    flush(out);

    if (bad == 0) return kDone;
    fmt::print(stderr, "regain: {} of {} lines could not be answered, line {} the first\n", bad,
               lines, first_bad);
    return kBadInput;
}

}  // namespace

void add_query(CLI::App& app, int& exit_code)
{
    CLI::App* command =
        app.add_subcommand("query", "JSON lines in, JSON lines out: any closure, any number");
    command->footer(help_footer);
    auto file = std::make_shared<std::string>("-");
    command->add_option("FILE", *file, "one query a line; - or nothing: standard input");
    command->callback(
        [file, &exit_code] { exit_code = run_reporting([&] { return run(*file); }); });
}

}  // namespace regain::tools
