// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "page.h"

#include "../false_colour.h"
#include "../figures/html.h"
#include "data_url.h"
#include "lobe_strips.h"
#include "machine.h"
#include "pareto_plot.h"

#include <regain/closures/version.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace regain::tools::cost {
namespace {

using figures::escaped;

std::string capital(std::string_view text)
{
    std::string out(text);
    out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
    return out;
}

bool same(const Front& f, Class kind, const Law& law)
{
    return f.kind == kind && f.law.label() == law.label();
}

std::vector<Front> fronts_for(const std::vector<Front>& all, Class kind, const Law& law)
{
    std::vector<Front> chosen;
    for (const Front& f : all)
        if (same(f, kind, law)) chosen.push_back(f);
    return chosen;
}

std::string plot_of(const std::vector<Front>& fronts)
{
    const Front& f = fronts.front();
    return pareto_plot(
        fmt::format("{}, {}: what accuracy costs", capital(words(f.kind)), f.law.label()), fronts);
}

// A method of a class and distribution, over all its rows.
struct Summary
{
    std::string method, refused;
    double error[std::size(bands)] = {-1, -1, -1};  // largest by band
    double tint = -1, shape = 0, variance = 0, eval = 0, sample = 0, eval_ratio = 0,
           sample_ratio = 0;
    std::size_t table_bytes = 0;
    int rows = 0;
};

std::vector<Summary> summaries(const Results& results, Class kind, const Law& law)
{
    std::vector<Summary> all;
    for (const Row& row : results.rows)
    {
        if (row.kind != kind || row.law.label() != law.label()) continue;
        auto s = std::find_if(all.begin(), all.end(),
                              [&](const Summary& m) { return m.method == row.method; });
        if (s == all.end()) s = all.insert(all.end(), Summary{row.method, row.refused});
        if (!row.refused.empty()) continue;
        for (std::size_t b = 0; b < std::size(bands); ++b)
            if (row.alpha >= bands[b].low && row.alpha <= bands[b].high)
                s->error[b] = std::max(s->error[b], row.errors.worst);
        s->tint = std::max(s->tint, row.errors.tint);
        s->shape += row.errors.shape;
        s->variance += row.errors.variance;
        s->eval += row.times.eval;
        s->sample += row.times.sample;
        s->eval_ratio += row.to_none.eval;
        s->sample_ratio += row.to_none.sample;
        s->table_bytes = std::max(s->table_bytes, row.table_bytes);
        ++s->rows;
    }
    return all;
}

std::string number(double x, const char* format)
{
    return x < 0 ? "-" : fmt::format(fmt::runtime(format), x);
}

// Methods of one reason together; the reason begins with the method's name.
void add_refusal(const Summary& s, std::vector<std::pair<std::string, std::string>>& refused)
{
    const std::string start = "the method " + s.method + " ";
    const std::string reason =
        s.refused.rfind(start, 0) == 0 ? s.refused.substr(start.size()) : s.refused;
    for (auto& [known, methods] : refused)
        if (known == reason)
        {
            methods += ", " + s.method;
            return;
        }
    refused.emplace_back(reason, s.method);
}

std::string summary_table(const Results& results, Class kind, const Law& law)
{
    figures::Table table{
        fmt::format("{}, {}", capital(words(kind)), law.label()),
        {"method", "error, alpha to 0.2", "error, between", "error, from 0.7", "tint", "shape",
         "variance", "eval ns", "ratio", "sample ns", "ratio", "tables"},
        {}};
    std::vector<std::pair<std::string, std::string>> refused;  // reason, methods
    for (const Summary& s : summaries(results, kind, law))
    {
        if (!s.refused.empty())
        {
            add_refusal(s, refused);
            continue;
        }
        const double n = s.rows;
        const auto ratio = [&](double sum) { return number(sum > 0 ? sum / n : -1, "{:.2f}"); };
        table.rows.push_back({s.method, number(s.error[0], "{:.4f}"), number(s.error[1], "{:.4f}"),
                              number(s.error[2], "{:.4f}"), number(s.tint, "{:.4f}"),
                              number(s.shape / n, "{:.3f}"), number(s.variance / n, "{:.4f}"),
                              number(s.eval / n, "{:.1f}"), ratio(s.eval_ratio),
                              number(s.sample / n, "{:.1f}"), ratio(s.sample_ratio),
                              fmt::format("{} B", s.table_bytes)});
    }
    std::string out = table.rows.empty() ? "" : figures::html_table(table);
    if (refused.empty()) return out;
    out += "<p>Not to be had:</p>\n<ul>\n";
    for (const auto& [reason, methods] : refused)
        out += fmt::format("<li><b>{}</b>: {}</li>\n", escaped(methods), escaped(reason));
    return out + "</ul>\n";
}

std::string strips(const Results& results, Class kind)
{
    std::vector<const LobeSet*> sets;
    for (const LobeSet& set : results.lobes)
        if (set.kind == kind) sets.push_back(&set);
    if (sets.empty()) return "";
    std::string out = fmt::format(
        "<table class=\"strips\"><caption>Lobe minus walk, {}, {}; along wo of cosine",
        escaped(sets.front()->part.label), escaped(results.choice.laws.front().label()));
    for (const std::size_t i : shape_cosines) out += fmt::format(" {}", cosines[i]);
    out += fmt::format(
        ". Red: too much; blue: too little; full colour: {:.0f} % of the walk's brightest bin. The "
        "hemisphere from above, the mirror direction to the right{}.</caption>\n<tr><th></th>",
        100 * strip_scale,
        kind == Class::glass_inside || kind == Class::glass_outside
            ? "; below it what is transmitted"
            : "");
    for (const LobeSet* set : sets) out += fmt::format("<th>alpha {}</th>", set->alpha);
    out += "</tr>\n";
    for (std::size_t m = 0; m < sets.front()->methods.size(); ++m)
    {
        out += fmt::format("<tr><td>{}</td>", escaped(sets.front()->methods[m].first));
        for (const LobeSet* set : sets)
            out += fmt::format("<td><img alt=\"{}, alpha {}\" src=\"{}\"/></td>",
                               escaped(set->methods[m].first), set->alpha,
                               data_url(lobe_strip(set->methods[m].second, set->walk, set->part)));
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

std::string class_part(const Results& results, const std::vector<Front>& fronts, Class kind,
                       const Law& law)
{
    std::string out;
    const std::vector<Front> own = fronts_for(fronts, kind, law);
    if (!own.empty())
    {
        out += plot_of(own);
        for (const Front& f : own) out += fmt::format("<p>{}</p>\n", escaped(f.sentence));
    }
    return out + summary_table(results, kind, law);
}

std::string pictures(const EqualTimeScene& scene)
{
    const auto config = shaders::ColorConfig::active();
    const auto shown = [&](const Picture& p) { return data_url(displayed(p, config, "", "")); };
    constexpr double scale = 0.1;
    std::string out = fmt::format(
        "<h3>{}</h3>\n<p>Each method has had the same time on the same threads. The error is "
        "against a walk of {:.0f} s, {:.0f} samples a pixel; it is noise as well as what the "
        "method does wrong, the last number much less so: it is taken over means of 16 x 16 "
        "pixels. How many samples fit depends on what else the machine does.</p>\n"
        "<div class=\"cells\">\n<figure><img alt=\"reference\" src=\"{}\"/>"
        "<figcaption>reference</figcaption></figure>\n",
        escaped(capital(scene.words)), scene.reference_seconds, scene.reference_samples,
        shown(scene.reference));
    for (const TimedPicture& p : scene.pictures)
        out += fmt::format(
            "<figure><img alt=\"{0}\" src=\"{1}\"/><img alt=\"{0}, error\" "
            "src=\"{2}\"/><figcaption><b>{0}</b>: {3:.2f} s, {4:.0f} samples a pixel, RMSE "
            "{5:.4f}, of means {6:.4f}</figcaption></figure>\n",
            escaped(p.method), shown(p.picture),
            data_url(false_colour(p.picture, scene.reference, scale)), p.seconds, p.samples, p.rmse,
            p.block_rmse);
    return out + "</div>\n";
}

constexpr const char* own_style = R"(
svg { max-width: 100%; height: auto; }
.strips td, .strips th { border: none; padding: .15em .4em; vertical-align: middle; }
.strips img { margin: 0; }
.cells { display: flex; flex-wrap: wrap; gap: 1em; }
figure { margin: 0; width: 216px; } figcaption { font-size: 13px; }
figure img { margin: 0 0 2px 0; }
)";

}  // namespace

std::string html_page(const Results& results, const std::vector<Front>& fronts)
{
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n<title>What accuracy "
        "costs, by Regain</title>\n<style>{}{}</style></head><body>\n<h1>What accuracy "
        "costs</h1>\n",
        figures::page_style, own_style);
    out += fmt::format(
        "<p>Regain {}. Every method of compensation against the random walk, which is exact for "
        "the model: error is the largest difference of the directional albedo over cosines from "
        "{} to {}, materials of the class and channels; tint the same of the colour; shape the "
        "L1 distance of the lobe. {} samples for each direction, the walk {}. Times are of one "
        "float at a time, prepare included, medians of methods measured in turns, on one thread "
        "of {}, {}{}.</p>\n",
        REGAIN_VERSION_STRING, cosines.front(), cosines.back(), results.samples,
        results.walk_samples, escaped(processor()), escaped(compiler()),
        results.quick ? ". A quick run: few widths, few samples" : "");
    const auto& laws = results.choice.laws;
    for (const Class kind : results.choice.classes)
    {
        out += fmt::format("<h2 id=\"{}\">{}</h2>\n", name(kind), capital(words(kind)));
        out += class_part(results, fronts, kind, laws.front());
        out += strips(results, kind);
        for (std::size_t i = 1; i < laws.size(); ++i)
            out +=
                fmt::format("<details><summary>{}</summary>\n{}</details>\n",
                            escaped(laws[i].label()), class_part(results, fronts, kind, laws[i]));
    }
    if (!results.pictures.empty()) out += "<h2 id=\"equal-time\">In equal time</h2>\n";
    for (const EqualTimeScene& scene : results.pictures) out += pictures(scene);
    return out + "</body></html>\n";
}

std::vector<std::pair<std::string, std::string>> plots(const std::vector<Front>& fronts)
{
    std::vector<std::pair<std::string, std::string>> all;
    std::string last;
    for (const Front& f : fronts)
    {
        std::string label = f.law.label();
        std::replace(label.begin(), label.end(), ' ', '-');
        const std::string file = fmt::format("pareto-{}-{}.svg", name(f.kind), label);
        if (file != last) all.emplace_back(file, plot_of(fronts_for(fronts, f.kind, f.law)));
        last = file;
    }
    return all;
}

}  // namespace regain::tools::cost
