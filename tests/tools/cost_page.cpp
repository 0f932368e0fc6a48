// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A browser shows the page of `regain cost` without asking for anything else. Debian: chromium.

#include "command.h"

#include <cstdlib>

using test::says;

namespace {

class CostPage : public test::Command
{
protected:
    static std::string browser()
    {
        for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
            if (std::system(fmt::format("command -v {} >/dev/null", name).c_str()) == 0)
                return name;
        return "";
    }

    // The document as the browser has it once the page is loaded.
    std::string shown(const std::string& page) const
    {
        write("page.html", page);
        const std::string line = fmt::format(
            "{0} --headless --no-sandbox --disable-gpu --user-data-dir='{1}/profile' "
            "--virtual-time-budget=20000 --dump-dom 'file://{1}/page.html' >'{1}/dom' 2>'{1}/said'",
            browser(), folder.string());
        EXPECT_EQ(std::system(line.c_str()), 0) << read("said");
        return read("dom");
    }
    // The page under a policy that lets it have nothing but itself. The title says how often that
    // was broken, and how many pictures and lines of plots have a size.
    static std::string with_count(std::string page)
    {
        const std::string script =
            R"(<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:;
 style-src 'unsafe-inline'; script-src 'unsafe-inline'"/>
<script>
let asked = 0;
document.addEventListener('securitypolicyviolation', () => { ++asked; });
window.onload = () => {
  const images = [...document.images].filter(i => i.naturalWidth > 0).length;
  const lines = [...document.querySelectorAll('svg polyline.front')]
      .filter(l => l.getTotalLength() > 0).length;
  document.title = `asked ${asked} images ${images} lines ${lines}`;
};
</script>
)";
        return page.insert(page.find("<meta"), script);
    }
};

}  // namespace

TEST_F(CostPage, stands_alone_in_a_browser)
{
    if (browser().empty())
        GTEST_SKIP() << "no chromium on the path: the page was not opened in a browser";
    const auto o = run(
        "cost --quick --quiet --samples 512 --seconds-per-picture 0.1 --class metal --distribution "
        "ggx --method none,directional,walk -o FOLDER/cost");
    ASSERT_EQ(o.code, 0) << o.err;
    const std::string page = read("cost/cost.html");
    // A strip for each of three methods at two widths; the reference; a picture and an error each.
    // A front for each of three roughnesses.
    const std::string dom = shown(with_count(page));
    EXPECT_TRUE(says(dom, "<title>asked 0 images 13 lines 3</title>")) << dom.substr(0, 2000);
    EXPECT_TRUE(says(dom, "directional</text>"));

    // The count would show it.
    std::string other = page;
    other.replace(other.find("</body>"), 7, "<img src=\"elsewhere.png\"/></body>");
    EXPECT_TRUE(says(shown(with_count(other)), "<title>asked 1 images 13"));
}
