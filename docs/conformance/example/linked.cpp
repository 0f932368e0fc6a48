// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The adapter, linked in: a closure and a subject in C++, and a program that runs the kit.

#include "phong.h"

#include <regain/conformance/run.h>

#include <exception>
#include <iostream>

using namespace regain;
using namespace regain::conformance;

class TestedPhong : public TestedClosure
{
public:
    explicit TestedPhong(const phong& p) : _phong(p) {}

    Traits traits() const override
    {
        Traits t;
        t.reciprocal = t.exact_pdf = true;
        t.random_numbers = 3;
        return t;
    }
    void prepare(const Direction& wo) override { _wo = wo; }
    Color eval(const Direction& wi, const Direction&) const override
    {
        Color f;
        phong_eval(&_phong, &_wo.x, &wi.x, &f.x);
        return f;
    }
    double pdf(const Direction& wi) const override { return phong_pdf(&_phong, &_wo.x, &wi.x); }
    Sample<double> sample(const Direction& u) const override
    {
        Sample<double> s{Direction(0, 0, 1), Color(0.0), 0};
        Direction wi;
        if (!phong_sample(&_phong, &_wo.x, &u.x, &wi.x)) return s;
        s.valid = true;
        s.wi = wi;
        s.pdf = pdf(wi);
        s.weight = eval(wi, u) / s.pdf;
        return s;
    }
    // No closed form: 0, and nothing is promised of it.
    Albedo<double> albedo() const override { return {Color(0.0), Color(0.0)}; }

private:
    phong _phong;
    Direction _wo{0, 0, 1};
};

class Phong : public Subject
{
public:
    std::string name() const override { return "phong"; }
    Reads reads() const override
    {
        Reads r;
        r.alpha = r.twice = true;
        return r;
    }
    std::unique_ptr<TestedClosure> make(const Parameters& p) const override
    {
        return std::make_unique<TestedPhong>(phong_make(p.alpha_x));
    }
    Promises promises(const Parameters& p, const Direction&) const override
    {
        Promises promised;
        promised.surplus = 0;
        promised.furnace = promised.albedo = std::nullopt;
        const phong made = phong_make(p.alpha_x);
        promised.weight = phong_largest_weight(&made);
        return promised;
    }
};

// Understands the commands that failures print: --subject, --check and --setting, each with one
// value.
int main(int argc, char** argv)
try
{
    Options options;
    options.command = argv[0];
    for (int i = 1; i + 1 < argc; i += 2)
    {
        const std::string option = argv[i], value = argv[i + 1];
        if (option == "--subject") options.subject = value;
        if (option == "--check") options.checks = {value};
        if (option == "--setting") options.setting = value;
    }
    const Phong subject;
    const Report report = run({&subject}, options);
    write_summary(std::cout, report);
    return report.passed() ? 0 : 1;
}
catch (const std::exception& e)
{
    std::cerr << e.what() << "\n";
    return 2;
}
