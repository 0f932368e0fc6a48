// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A subject of the plain C interface as the kit's own kind.

#pragma once

#include <regain/conformance/c_closure.h>
#include <regain/conformance/subject.h>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

class CSubject final : public Subject
{
public:
    /// `c` has all its functions; `library` keeps what it points to.
    CSubject(const regain_subject_v1& c, std::shared_ptr<void> library);

    std::string name() const override { return _c.name; }
    Reads reads() const override;
    std::unique_ptr<TestedClosure> make(const Parameters&) const override;
    Promises promises(const Parameters&, const Direction& wo) const override;
    const Subject* bare() const override { return _bare; }
    const Subject* reference() const override { return _reference; }
    Form form() const override { return static_cast<Form>(_c.form); }

    const regain_subject_v1& c() const { return _c; }
    void relate(const Subject* bare, const Subject* reference)
    {
        _bare = bare;
        _reference = reference;
    }

private:
    const regain_subject_v1& _c;
    std::shared_ptr<void> _library;
    const Subject *_bare = nullptr, *_reference = nullptr;
};

}  // namespace conformance
REGAIN_NAMESPACE_END
