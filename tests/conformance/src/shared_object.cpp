// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/conformance/shared_object.h>

#include "c_subject.h"
#include "names.h"

#include <dlfcn.h>

#include <cmath>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

namespace fs = std::filesystem;

namespace {

// A function that never answers null would be asked for ever.
constexpr int most_subjects = 1000;

class Loader
{
public:
    explicit Loader(const fs::path& file) : _file(file) {}

    std::vector<std::unique_ptr<Subject>> load()
    {
        open();
        dlerror();
        // POSIX has a function's address come out as an object's.
        const auto subject_at = reinterpret_cast<regain_conformance_subject_function>(
            dlsym(_library.get(), REGAIN_CONFORMANCE_SUBJECT));
        if (!subject_at)
            fail("it exports no function " REGAIN_CONFORMANCE_SUBJECT
                 "; see regain/conformance/c_closure.h (in C++ it has to be extern \"C\")");

        std::vector<std::unique_ptr<CSubject>> subjects;
        for (int i = 0; const regain_subject_v1* c = subject_at(i); ++i)
        {
            if (i == most_subjects)
                fail("it has more than " + std::to_string(most_subjects) +
                     " subjects: " REGAIN_CONFORMANCE_SUBJECT " has to return null past the last");
            require_usable(*c, "subject " + std::to_string(i));
            for (const auto& other : subjects)
                if (other->name() == c->name)
                    fail("two of its subjects are called '" + other->name() + "'");
            subjects.push_back(std::make_unique<CSubject>(*c, _library));
        }
        if (subjects.empty()) fail("it has no subjects: " REGAIN_CONFORMANCE_SUBJECT "(0) is null");

        std::vector<std::unique_ptr<Subject>> all;
        for (const auto& s : subjects)
            s->relate(named(subjects, s->c().bare, *s), named(subjects, s->c().reference, *s));
        for (auto& s : subjects) all.push_back(std::move(s));
        return all;
    }

private:
    [[noreturn]] void fail(const std::string& why) const
    {
        throw std::runtime_error("cannot use '" + _file.string() + "': " + why);
    }

    void open()
    {
        std::error_code ec;
        if (!fs::exists(_file, ec)) fail("there is no such file");
        if (fs::is_directory(_file, ec)) fail("it is a folder");
        // A name without a slash would be looked for elsewhere.
        void* handle = dlopen(fs::absolute(_file).c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!handle)
        {
            const char* why = dlerror();
            fail("it cannot be loaded as a shared object (" +
                 std::string(why ? why : "no reason was given") + ")");
        }
        _library = std::shared_ptr<void>(handle, [](void* h) { dlclose(h); });
    }

    // The version comes first: of another, nothing else is known to be there.
    void require_usable(const regain_subject_v1& c, const std::string& which) const
    {
        if (c.version < 1 || c.version > REGAIN_CONFORMANCE_C_VERSION)
            fail(which + " was written for version " + std::to_string(c.version) +
                 " of the interface; this kit knows 1 to " +
                 std::to_string(REGAIN_CONFORMANCE_C_VERSION));
        if (c.size != sizeof(regain_subject_v1))
            fail(which + " says that its struct has " + std::to_string(c.size) +
                 " bytes; in version 1 it has " + std::to_string(sizeof(regain_subject_v1)));
        if (!c.name) fail(which + " has no name: it is null");
        if (const std::string why = why_unusable(c.name); !why.empty()) fail(which + ": " + why);

        const std::string name = "'" + std::string(c.name) + "'";
        const auto need = [&](bool there, const char* function) {
            if (!there) fail("the function " + std::string(function) + " of " + name + " is null");
        };
        need(c.create, "create");
        need(c.destroy, "destroy");
        need(c.traits, "traits");
        need(c.eval, "eval");
        need(c.pdf, "pdf");
        need(c.sample, "sample");
        need(c.albedo, "albedo");

        const regain_reads_v1& reads = c.reads;
        if (!reads.in_float && !reads.in_double)
            fail(name +
                 " computes neither in float nor in double: set reads.in_float or in_double");
        // Written so that NaN is refused, too.
        if (reads.gamma &&
            !(std::isfinite(reads.lowest_gamma) && std::isfinite(reads.highest_gamma) &&
              reads.lowest_gamma <= reads.highest_gamma))
            fail(name + " reads gamma from " + std::to_string(reads.lowest_gamma) + " to " +
                 std::to_string(reads.highest_gamma) + ", which is no range");
        if (c.form < REGAIN_FORM_NONE || c.form > REGAIN_FORM_PAIR_GAIN)
            fail("the form of " + name + " is " + std::to_string(c.form) + "; accepted: " +
                 std::to_string(REGAIN_FORM_NONE) + " to " + std::to_string(REGAIN_FORM_PAIR_GAIN));
    }

    const Subject* named(const std::vector<std::unique_ptr<CSubject>>& subjects, const char* name,
                         const CSubject& asking) const
    {
        if (!name) return nullptr;
        for (const auto& s : subjects)
            if (s->name() == name && s.get() != &asking) return s.get();
        fail("'" + asking.name() + "' names '" + name +
             "', and no other of its subjects is called that");
    }

    fs::path _file;
    std::shared_ptr<void> _library;
};

}  // namespace

std::vector<std::unique_ptr<Subject>> load_shared_object(const fs::path& file)
{
    return Loader(file).load();
}

}  // namespace conformance
REGAIN_NAMESPACE_END
