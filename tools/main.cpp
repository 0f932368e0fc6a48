// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "commands.h"
#include "errors.h"

#include <regain/closures/version.h>

#include <CLI/CLI.hpp>

int main(int argc, char** argv)
{
    using namespace regain::tools;

    CLI::App app{"Regain: shading closures with energy compensation", "regain"};
    app.set_version_flag("--version", "regain " REGAIN_VERSION_STRING);
    app.require_subcommand(1);

    int exit_code = kDone;
    add_render(app, exit_code);
    add_figures(app, exit_code);
    add_albedo(app, exit_code);
    add_query(app, exit_code);
    add_bake(app, exit_code);
    add_conform(app, exit_code);
    add_cost(app, exit_code);
    add_plan(app, exit_code);
    add_presets(app, exit_code);

    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& e)
    {
        // CLI11 numbers its errors; here anything but help and version is bad input.
        return app.exit(e) == 0 ? kDone : kBadInput;
    }
    return exit_code;
}
