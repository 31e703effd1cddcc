#include "plots/canvas.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "algebra/constants.h"
#include "messages/input_error.h"
#include "messages/names.h"

namespace whirl_twin {
namespace {

cairo_status_t append(void* file, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// To an eighth of a pixel: more is invisible and makes files longer. (Cairo counts in 1/256.)
double rounded(double pixels) {
  return std::round(8.0 * pixels) / 8.0;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : printableLines(text)) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return out;
}

Ink mixed(const Ink& ink, double share, double other) {
  const auto mix = [share, other](double part) { return part + share * (other - part); };
  return {mix(ink.red), mix(ink.green), mix(ink.blue)};
}

}  // namespace

ImageFormat imageFormat(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension();
  if (extension != ".svg" && extension != ".png") {
    throw InputError(fmt::format("a picture: must end in .svg or .png, found '{}'", path));
  }
  return extension == ".svg" ? ImageFormat::kSvg : ImageFormat::kPng;
}

Ink paler(const Ink& ink, double share) {
  return mixed(ink, share, 1.0);
}

Ink darker(const Ink& ink, double share) {
  return mixed(ink, share, 0.0);
}

struct Canvas::Sheet {
  ImageFormat format;
  std::string title, description;
  std::string file;
  cairo_surface_t* surface;
  cairo_t* cairo;

  void use(const Ink& ink) { cairo_set_source_rgb(cairo, ink.red, ink.green, ink.blue); }
  void stroke(const Pen& pen) {
    use(pen.ink);
    cairo_set_line_width(cairo, pen.width);
    cairo_set_dash(cairo, pen.dash.data(), static_cast<int>(pen.dash.size()), 0.0);
    cairo_stroke(cairo);
  }
  void choose(const Lettering& lettering) {
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           lettering.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, lettering.size);
  }
};

Canvas::Canvas(ImageFormat format, int width, int height, std::string title,
               std::string description)
    : sheet_(std::make_unique<Sheet>()) {
  sheet_->format = format;
  sheet_->title = std::move(title);
  sheet_->description = std::move(description);
  if (format == ImageFormat::kSvg) {
    sheet_->surface = cairo_svg_surface_create_for_stream(append, &sheet_->file, width, height);
    cairo_svg_surface_set_document_unit(sheet_->surface, CAIRO_SVG_UNIT_PX);
  } else {
    sheet_->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  }
  sheet_->cairo = cairo_create(sheet_->surface);
  cairo_set_line_cap(sheet_->cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(sheet_->cairo, CAIRO_LINE_JOIN_ROUND);
  sheet_->use({1.0, 1.0, 1.0});
  cairo_paint(sheet_->cairo);
}

Canvas::~Canvas() {
  cairo_destroy(sheet_->cairo);
  cairo_surface_destroy(sheet_->surface);
}

void Canvas::lines(const std::vector<std::vector<Spot>>& pieces, const Pen& pen) {
  for (const std::vector<Spot>& spots : pieces) {
    if (!spots.empty()) {
      cairo_move_to(sheet_->cairo, rounded(spots[0].x), rounded(spots[0].y));
    }
    for (const Spot& spot : spots) {
      cairo_line_to(sheet_->cairo, rounded(spot.x), rounded(spot.y));
    }
  }
  if (cairo_has_current_point(sheet_->cairo) != 0) {
    sheet_->stroke(pen);
  }
}

void Canvas::polygon(const std::vector<Spot>& corners, const Ink& fill, const Pen& outline) {
  for (const Spot& corner : corners) {
    cairo_line_to(sheet_->cairo, rounded(corner.x), rounded(corner.y));
  }
  cairo_close_path(sheet_->cairo);
  sheet_->use(fill);
  cairo_fill_preserve(sheet_->cairo);
  sheet_->stroke(outline);
}

void Canvas::circle(const Spot& centre, double radius, const Ink& fill, const Pen& outline) {
  cairo_new_sub_path(sheet_->cairo);
  cairo_arc(sheet_->cairo, rounded(centre.x), rounded(centre.y), rounded(radius), 0.0, kTwoPi);
  cairo_close_path(sheet_->cairo);
  sheet_->use(fill);
  cairo_fill_preserve(sheet_->cairo);
  sheet_->stroke(outline);
}

void Canvas::text(const Spot& at, const std::string& words, const Lettering& lettering) {
  constexpr double kCapital = 0.73;  // height of a capital letter over the size of the font
  const auto part = [](Align align) {
    return align == Align::kStart ? 0.0 : align == Align::kMiddle ? 0.5 : 1.0;
  };
  const double left = -part(lettering.across) * textWidth(words, lettering);
  const double base = (1.0 - part(lettering.down)) * kCapital * lettering.size;
  cairo_t* cairo = sheet_->cairo;
  cairo_save(cairo);
  cairo_translate(cairo, at.x, at.y);
  if (lettering.upwards) {
    cairo_rotate(cairo, -0.5 * kPi);
  }
  cairo_move_to(cairo, left, base);
  sheet_->choose(lettering);
  sheet_->use(lettering.ink);
  cairo_show_text(cairo, words.c_str());
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

double Canvas::textWidth(const std::string& words, const Lettering& lettering) {
  sheet_->choose(lettering);
  cairo_text_extents_t extents;
  cairo_text_extents(sheet_->cairo, words.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::clip(const Spot& corner, double width, double height) {
  cairo_save(sheet_->cairo);
  cairo_rectangle(sheet_->cairo, corner.x, corner.y, width, height);
  cairo_clip(sheet_->cairo);
}

void Canvas::unclip() {
  cairo_restore(sheet_->cairo);
}

std::string Canvas::finish() {
  cairo_status_t status = cairo_status(sheet_->cairo);
  if (status == CAIRO_STATUS_SUCCESS && sheet_->format == ImageFormat::kPng) {
    status = cairo_surface_write_to_png_stream(sheet_->surface, append, &sheet_->file);
  } else if (status == CAIRO_STATUS_SUCCESS) {
    cairo_surface_finish(sheet_->surface);
    status = cairo_surface_status(sheet_->surface);
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    throw RunFailure(
        fmt::format("a picture could not be drawn: {}", cairo_status_to_string(status)));
  }
  if (sheet_->format == ImageFormat::kSvg) {
    // Cairo writes letters as glyph outlines; the plain text is inserted here.
    const std::size_t head = sheet_->file.find('>', sheet_->file.find("<svg")) + 1;
    sheet_->file.insert(head, fmt::format("\n<title>{}</title>\n<desc>{}</desc>",
                                          escaped(sheet_->title), escaped(sheet_->description)));
  }
  return std::move(sheet_->file);
}

}  // namespace whirl_twin
