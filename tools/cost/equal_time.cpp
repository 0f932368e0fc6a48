// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "equal_time.h"

#include "../errors.h"
#include "../false_colour.h"
#include "../preview/render_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

namespace regain::tools::cost {
namespace {

using Clock = std::chrono::steady_clock;
using figures::Request;
using figures::Stopped;

constexpr int width = 216, height = 180;
constexpr double alpha = 0.7;

// Time is given in slices, in turn, so that a slow moment of the machine meets all methods.
constexpr int slices = 6;

// Sets its flag at the deadline, or when the user wants to stop.
class Deadline
{
public:
    Deadline(double seconds, const Request& request)
        : _thread([this, seconds, &request] {
              const auto end = Clock::now() + std::chrono::duration<double>(seconds);
              std::unique_lock<std::mutex> lock(_mutex);
              while (!_done && !request.stopped() && Clock::now() < end)
                  _woken.wait_for(lock, std::chrono::milliseconds(5));
              _flag.store(true);
          })
    {}
    ~Deadline()
    {
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _done = true;
        }
        _woken.notify_all();
        _thread.join();
    }
    const std::atomic<bool>& flag() const { return _flag; }

private:
    std::atomic<bool> _flag{false};
    std::mutex _mutex;
    std::condition_variable _woken;
    bool _done = false;
    std::thread _thread;  // last: it uses the others
};

// A picture that is rendered a slice at a time.
class Growing
{
public:
    Growing(const Request& request, const figures::Cell& cell)
        : _request(request), _stage(request, cell, width, height)
    {
        _film.emplace(_stage.width(), _stage.height());
        // Every pixel has something, however short the time.
        render(1, request.stop);
    }

    void grow_until(double seconds)
    {
        if (seconds <= _seconds) return;
        const Deadline deadline(seconds - _seconds, _request);
        render(std::numeric_limits<int>::max(), &deadline.flag());
    }

    double seconds() const { return _seconds; }
    double samples() const
    {
        double sum = 0;
        for (int y = 0; y < _film->height(); ++y)
            for (int x = 0; x < _film->width(); ++x) sum += _film->samples(x, y);
        return sum / (double(_film->width()) * _film->height());
    }
    Picture picture() const
    {
        Picture p{_film->width(), _film->height(), {}};
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x) p.pixels.push_back(_film->mean(x, y));
        return p;
    }

private:
    void render(int samples, const std::atomic<bool>* stop)
    {
        preview::RenderJob job;
        job.targets.push_back({&_stage.integrator(), &*_film});
        job.samples = samples;
        job.threads = _request.threads;
        job.stop = stop;
        const auto start = Clock::now();
        preview::render(job);
        _seconds += std::chrono::duration<double>(Clock::now() - start).count();
        if (_request.stopped()) throw Stopped();
    }

    const Request& _request;
    figures::CellStage _stage;
    std::optional<preview::Film> _film;
    double _seconds = 0;
};

using MakeMaterial = shaders::MicrofacetMaterial (*)(double, const shaders::Compensation&);

shaders::MicrofacetMaterial beta_glass(double a, const shaders::Compensation& method)
{
    shaders::MicrofacetMaterial m = figures::glass(a, method);
    std::get<shaders::InterfaceSurface>(m.surface).shadowing = TransmissionShadowing::beta;
    return m;
}

EqualTimeScene timed_scene(const std::string& name, const std::string& words,
                           preview::RowLayout layout, MakeMaterial make, const Choice& choice,
                           double seconds, const Request& request)
{
    const auto cell_of = [&](const shaders::Compensation& method) {
        figures::Cell cell;
        cell.layout = layout;
        cell.objects.push_back(make(alpha, method));
        return cell;
    };
    EqualTimeScene scene{name, words, {}, 0, 0, {}};
    std::vector<std::unique_ptr<Growing>> growing;
    for (const shaders::Compensation& method : choice.methods)
    {
        shaders::MicrofacetMaterial material = make(alpha, method);
        try
        {
            material.bind_tables();
        }
        // What the library refuses is told with the numbers of its class.
        catch (const std::exception&)
        {
            continue;
        }
        TimedPicture picture;
        picture.method = shaders::name(method);
        scene.pictures.push_back(picture);
        growing.push_back(std::make_unique<Growing>(request, cell_of(method)));
    }

    constexpr int reference_turns = 10;
    Progress progress(fmt::format("pictures of {} in equal time", name),
                      static_cast<std::uint64_t>(slices) * (growing.size() + reference_turns),
                      request.progress);
    for (int slice = 1; slice <= slices; ++slice)
        for (const auto& g : growing)
        {
            g->grow_until(seconds * slice / slices);
            progress.advance();
        }
    Request other = request;
    other.seed += 1000;  // its noise is its own
    Growing reference(other, cell_of(shaders::RandomWalk{}));
    for (int turn = 1; turn <= slices * reference_turns; ++turn)
    {
        reference.grow_until(seconds * turn / slices);
        progress.advance();
    }
    scene.reference = reference.picture();
    scene.reference_seconds = reference.seconds();
    scene.reference_samples = reference.samples();
    for (std::size_t i = 0; i < growing.size(); ++i)
    {
        TimedPicture& p = scene.pictures[i];
        p.picture = growing[i]->picture();
        p.seconds = growing[i]->seconds();
        p.samples = growing[i]->samples();
        p.rmse = difference_of(p.picture, scene.reference).rms;
        p.block_rmse = figures::difference(p.picture, scene.reference);
    }
    return scene;
}

}  // namespace

std::vector<EqualTimeScene> equal_time_scenes(const Choice& choice, double seconds,
                                              const Request& request)
{
    std::vector<EqualTimeScene> scenes;
    if (seconds <= 0) return scenes;
    const auto chosen = [&](Class a, Class b) {
        return std::any_of(choice.classes.begin(), choice.classes.end(),
                           [&](Class c) { return c == a || c == b; });
    };
    if (chosen(Class::metal, Class::coloured))
        scenes.push_back(timed_scene("gold", "a widget of gold, alpha 0.7", {}, figures::gold,
                                     choice, seconds, request));
    if (chosen(Class::glass_outside, Class::glass_inside))
    {
        preview::RowLayout layout;
        layout.transparent = true;
        scenes.push_back(timed_scene("glass", "a widget of glass, eta 1.5, alpha 0.7", layout,
                                     beta_glass, choice, seconds, request));
    }
    return scenes;
}

}  // namespace regain::tools::cost
