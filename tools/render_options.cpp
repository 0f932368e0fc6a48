// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_options.h"

#include <CLI/CLI.hpp>

namespace regain::tools {

namespace {

void declare_materials(RenderOptions& o, CLI::App& command)
{
    command.add_option("--material", o.material, "metal, glass, or sheen (a cloth)")
        ->capture_default_str();
    command.add_option(
        "--metal", o.metal,
        "one of `regain presets list --kind metal`: silver, copper, brass ... [gold]");
    command.add_option("--ior", o.ior,
                       "of glass: index inside over index outside, 0.1 to 10; of thin-walled "
                       "glass, of the sheet over what is around it [1.5]");
    command.add_flag("--thin-walled", o.thin_walled,
                     "glass as a sheet with two sides, as of a bubble or a window");
    command.add_option("--scatter-mode", o.scatter_mode,
                       "what glass does: R reflects, T transmits, RT both [RT]");
    command.add_option("--transmission-shadowing", o.transmission_shadowing,
                       "of what glass transmits: correlated or beta [correlated; beta for the "
                       "method walk]");
    command
        .add_option("--weight", o.weights, "of sheen, one object each, 0 to 1 [0,0.25,0.5,0.75,1]")
        ->delimiter(',');
    command.add_option("--base", o.base,
                       "albedo of the dull cloth under the sheen, 0 (sheen alone) to 1 [0.05]");
    command
        .add_option("--alpha", o.alphas,
                    "microfacet widths, one object each, 0 to 1 [0.05,0.2,0.4,0.6,0.8,1]")
        ->delimiter(',');
    command.add_option("--alpha-ratio", o.alpha_ratio,
                       "width around the object over width up and down it, 0.01 to 100; alpha is "
                       "the greater of the two [1]");
    command.add_option("--distribution", o.distribution,
                       "of facets: ggx, beckmann, gtr or std [ggx]");
    command.add_option("--gamma", o.gamma, "tail of gtr (up to 10) and std (1.51 to 100) [2]");
}

}  // namespace

void declare(RenderOptions& o, CLI::App& command)
{
    command.footer(
        R"(Without options: gold of rising roughness, without compensation (top) and with
the method directional (bottom), after Figure 1 of Turquin 2019; glass has tail
there, or turquin where that does not go with it. Sheen has no
roughness: one row of rising weight, as in Figure 3. Ctrl-C writes what there is,
marked with regain:partial = 1.

Examples:
  regain render
  regain render --metal copper --alpha 0.1,0.5,1 --size 900x640 -o copper.exr
  regain render --method series --environment studio.hdr --spp 256
  regain render --host clarisse --view raw --json
  regain render --alpha 0.2,0.4,0.8 --alpha-ratio 4
  regain render --material glass --ior 1.5 --object sphere --alpha 0,0.2,0.5
  regain render --material glass --object nested --environment white --method turquin
  regain render --material glass --thin-walled --object sphere
  regain render --material glass --scatter-mode T --transmission-shadowing beta
  regain render --material sheen --weight 0,0.5,1 --base 0.1
  regain render car.mtlx --environment studio.hdr
  regain render gold --select gold_satin --wedge roughness=0.01..1:8 --labels
  regain render gold --select gold_rough --wedge roughness=0.1..1:6 --labels --method none,tail
  regain render car.mtlx --set coat_weight=0 --difference car.exr -o uncoated.exr
  regain render car.mtlx --tolerance 0.01 -o planned.exr
  regain render car.mtlx --turntable 90 -o turn.exr --resume
  regain render car.mtlx --watch --spp 8
  regain render car.mtlx --spp 4096 --resume
  regain render car.mtlx --spp 4096 -o car.exr --part 3/7     on one of seven machines
  regain render car.mtlx --spp 4096 -o car.exr --merge car.part-*-of-7
  regain render silver --furnace
  regain render materials.mtlx --select Gold --select Varnish --host osl
  regain render --plugin surface.so --set coat=1 --set base_color=0.1,0.2,0.6
  regain render --distribution gtr --gamma 1.5 --method walk)");
    command.add_option("-o,--output", o.output, "EXR to write; the PNG goes beside it")
        ->capture_default_str();
    command.add_option(
        "--method", o.method,
        "a row for each of these compensation methods, divided by commas, instead of none above "
        "the recommended one");
    command.add_option(
        "--tolerance", o.tolerance,
        "of documents: the cheapest methods whose predicted error of the "
        "directional albedo is within that, 0 (the reference) to 1; see regain plan");
    command.add_option("--costs", o.costs,
                       "what --tolerance goes by, a file of `regain cost --planner-data` [compiled "
                       "in]");
    declare_materials(o, command);
    command.add_option("DOCUMENT", o.documents,
                       "MaterialX documents, or names of presets: one object for each of their "
                       "materials, compensated as recommended or by --method");
    command.add_option("--select", o.selected, "only that material of the documents, repeated")
        ->allow_extra_args(false);
    command
        .add_option("--wedge", o.wedge,
                    "INPUT=FROM..TO:N: each material of the documents N times, in a row, with "
                    "that value of an input")
        ->type_name("INPUT=A..B:N");
    command.add_option("--columns", o.columns, "objects in a row of documents, 1 to 16")
        ->capture_default_str();
    command.add_flag("--labels", o.labels,
                     "the name of its material, or its width, below each object");
    command.add_option("--object", o.object, "widget, sphere, or nested (a sphere in a sphere)")
        ->capture_default_str();
    command.add_option("--host", o.host,
                       "renderman (batched), clarisse (one point) or osl (trees of closures) "
                       "[renderman, or the one a plug-in is for]");
    command.add_option("--plugin", o.plugin,
                       "shared object with a material for one of the hosts; one object is shown");
    command
        .add_option("--set", o.settings,
                    "NAME=NUMBER or NAME=R,G,B of the plug-in's, or of documents INPUT=VALUE or "
                    "NODE.INPUT=VALUE, repeated")
        ->allow_extra_args(false);
    command.add_option("--environment", o.environment,
                       "latitude-longitude EXR or HDR that lights the scene, or white: 1 from "
                       "everywhere, and no floor [built-in studio]");
    command
        .add_option("--rotate", o.rotate,
                    "degrees by which the environment is turned, anticlockwise from above")
        ->capture_default_str();
    command
        .add_option("--turn", o.turn,
                    "degrees by which each object is turned about its own vertical, "
                    "anticlockwise from above")
        ->capture_default_str();
    command.add_option("--turntable", o.turntable,
                       "2 to 9999 pictures, NAME.0001.exr and on, in which the objects turn once "
                       "round; with --resume those that are there are left as they are");
    command.add_flag("--watch", o.watch,
                     "render again whenever a document is changed, until Ctrl-C");
    command.add_flag("--furnace", o.furnace,
                     "light of 1 from everywhere, no floor; the PNG shows what is lost (blue) and "
                     "what is too much (red), with its scale");
    command.add_flag("--resume", o.resume,
                     "go on with a render that was interrupted, from NAME.resume.exr, which an "
                     "interrupt leaves; the picture is as if it had not been. Where there is none, "
                     "begin");
    declare(o.parts, command);
    command.add_option(
        "--aov", o.aovs,
        "layers of the EXR, divided by commas, of the first surface in view: albedo, "
        "gain (that over the albedo without compensation), lobe and method (numbers "
        "of the closure that most of it is from; the file says which)");
    command.add_option("--difference", o.difference,
                       "EXR of the same size: besides the picture, NAME.difference.png shows how "
                       "far it is from that, with its scale");
    command.add_option("--scale", o.scale,
                       "what the strongest colours of --furnace and --difference mean [0.05; the "
                       "largest difference]");
    command.add_option("--spp", o.samples, "samples per pixel, 1 to 65536")->capture_default_str();
    command.add_option("--seed", o.seed, "of the random numbers")->capture_default_str();
    command.add_option("--bounces", o.bounces, "at most, per path [16; 64 for glass]");
    command.add_option("--size", o.size, "WIDTHxHEIGHT of the whole picture, in pixels");
    command.add_option("--threads", o.threads, "0: one per core; never changes the picture")
        ->capture_default_str();
    command.add_option("--display", o.display, "OCIO display of the PNG [the config's default]");
    command.add_option("--view", o.view, "OCIO view of the PNG [the display's default]");
    command.add_flag("--quiet", o.quiet, "no progress, no summary");
    command.add_flag("--json", o.json, "summary as one line of JSON on standard output");
}

}  // namespace regain::tools
