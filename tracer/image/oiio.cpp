#include "tracer/image/oiio.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <shared_mutex>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/thread.h>

extern "C" {
#include "base/err.h"
#include "tracer/image/heads.h"
}

namespace {

/* Large enough for any frame, but small enough that a false header cannot exhaust memory. */
constexpr int64_t MAX_PIXELS = int64_t(1) << 28;
constexpr int MAX_CHANNELS = 256;
constexpr int STRIP_ROWS = 64;

/* Debian package fonts-dejavu-core. */
constexpr const char *FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

/** Held shared by each thread that is in OpenImageIO. */
std::shared_mutex in_use;

bool is_integer(const OIIO::TypeDesc &format)
{
	return !format.is_floating_point();
}

/**
 * Most pixels in a file of `bytes` bytes, for formats that at most pack runs: their readers return pixels that the file
 * does not have. A byte has at most 128 values, and a pixel at least one bit. Other readers stop at the end of the file
 * (read_part).
 */
int64_t most_pixels(const std::string &format, uint64_t bytes)
{
	for (const char *simple : { "bmp", "cineon", "dds", "dpx", "hdr", "pnm", "sgi", "targa" })
		if (format == simple)
			return std::min(MAX_PIXELS, int64_t(std::min(bytes, uint64_t(MAX_PIXELS)) * 1024));
	return MAX_PIXELS;
}

/** A channel of an image, and its index in the file. */
struct channel {
	float *plane;
	int from;
	bool is_number; /* OpenEXR's unsigned integers, read unchanged; OpenImageIO would scale them */
};

/** The window around the data of all parts of a file; each part may have its own data window in the common display
 * window. */
struct windows {
	int x, y, width, height;
	int n_parts;
};

/** Can the channels of one part be allocated? A head may claim any size; if it is too large, the file is at fault. */
bool has_room(const windows &all, int n_channels)
{
	void *volatile planes = calloc(size_t(all.width) * size_t(all.height),
	                               sizeof(float) * size_t(std::max(n_channels, 3)));

	free(planes);
	return planes != nullptr;
}

/** Add the channels of one part, all 0; `prefix` (a part's name and a dot, or nothing) is prepended to their names. */
int add_part(struct image *img, const OIIO::ImageSpec &spec, const std::string &prefix, bool is_exr,
             std::vector<channel> &out, const char *path)
{
	const bool grey = prefix.empty() && spec.nchannels <= 2 && spec.channel_name(0) != "R";
	const auto add = [&](const char *name, int from) {
		const OIIO::TypeDesc type = spec.channelformat(from);

		out.push_back({ image_add_channel(img, name, type != OIIO::TypeDesc::HALF), from,
		                is_exr && type == OIIO::TypeDesc::UINT32 });
		return out.back().plane != nullptr;
	};

	if (grey) {
		for (const char *name : { "R", "G", "B" })
			if (!add(name, 0))
				return ERR_SYSTEM;
		if (spec.nchannels == 2 && !add("A", 1))
			return ERR_SYSTEM;
	}
	for (int c = 0; !grey && c < spec.nchannels; c++) {
		const std::string name = prefix + std::string(spec.channel_name(c));

		if (name.empty() || name.size() >= sizeof(img->channels[0].name))
			return err_report(ERR_INPUT, path, "channel %d has no usable name", c);
		if (!image_channel(img, name.c_str()) && !add(name.c_str(), c))
			return ERR_SYSTEM;
	}
	return 0;
}

/** Read the pixels of one part in strips: the time for a truncated file then depends on its contents, not on its
 * head. */
int read_part(OIIO::ImageInput &in, const OIIO::ImageSpec &spec, int part, const windows &all,
              const std::vector<channel> &channels, const char *path)
{
	const int rows = std::min(spec.tile_width ? std::max(spec.tile_height, 1) : STRIP_ROWS, spec.height),
		  n = spec.nchannels;
	const size_t width = size_t(spec.width);
	std::vector<float> strip(width * size_t(rows) * size_t(n));

	for (int y = 0; y < spec.height; y += rows) {
		const int end = std::min(y + rows, spec.height);
		const bool good = spec.tile_width ?
		                          in.read_tiles(part, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end,
		                                        0, 1, 0, n, OIIO::TypeDesc::FLOAT, strip.data()) :
		                          in.read_scanlines(part, 0, spec.y + y, spec.y + end, 0, 0, n,
		                                            OIIO::TypeDesc::FLOAT, strip.data());

		if (!good)
			return err_report(ERR_INPUT, path, "%s", in.geterror().c_str());
		for (const channel &c : channels)
			for (size_t i = 0; i < width * size_t(end - y); i++) {
				const float value = strip[i * size_t(n) + size_t(c.from)];
				const size_t row = size_t(spec.y - all.y + y) + i / width;

				c.plane[row * size_t(all.width) + size_t(spec.x - all.x) + i % width] =
					c.is_number ? rintf(value * 4294967295.0f) : value;
			}
	}
	return 0;
}

/** Parse the lines of a description by display_write: "relume:NAME TEXT". */
int add_description(struct image *img, const std::string &text)
{
	std::istringstream lines(text);

	for (std::string line; std::getline(lines, line);) {
		const size_t space = line.find(' ');

		if (line.compare(0, 7, "relume:") == 0 && space != std::string::npos &&
		    image_set_attribute(img, line.substr(0, space).c_str(), "%s", line.c_str() + space + 1) != 0)
			return ERR_SYSTEM;
	}
	return 0;
}

int add_attributes(struct image *img, const OIIO::ImageSpec &spec)
{
	for (const char *name : { "relume:frame", "relume:encoding", "relume:trace", "relume:device" }) {
		const std::string text = spec.get_string_attribute(name);

		if (!text.empty() && image_set_attribute(img, name, "%s", text.c_str()) != 0)
			return ERR_SYSTEM;
	}
	if (int err = add_description(img, spec.get_string_attribute("ImageDescription")))
		return err;
	if (spec.get_int_attribute("oiio:UnassociatedAlpha") && image_set_attribute(img, "relume:alpha", "straight") != 0)
		return ERR_SYSTEM;
	if (!image_attribute(img, "relume:encoding"))
		return image_set_attribute(img, "relume:encoding", "%s", is_integer(spec.format) ? "display" : "linear");
	return 0;
}

/**
 * Prefix of the names of a part's channels: nothing for the first part or if the names already contain the layer, else
 * the part's name.
 */
std::string prefix_of(const OIIO::ImageSpec &spec, int part)
{
	const std::string name = spec.get_string_attribute("oiio:subimagename");

	if (part == 0 || name.empty() || spec.channel_name(0).find('.') != std::string::npos)
		return "";
	return name + ".";
}

/** Check the heads of all parts to be read. */
int find_windows(OIIO::ImageInput &in, bool all_parts, int64_t most, windows &out, const char *path)
{
	const OIIO::ImageSpec first = in.spec();
	int64_t x1 = int64_t(first.x) + first.width, y1 = int64_t(first.y) + first.height;

	out = { first.x, first.y, 0, 0, 0 };
	for (int part = 0; in.seek_subimage(part, 0) && (part == 0 || all_parts); part++) {
		const OIIO::ImageSpec &spec = in.spec();

		if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > MAX_CHANNELS ||
		    int64_t(spec.width) * spec.height > most)
			return err_report(ERR_INPUT, path, "not a picture of sane size: %d x %d x %d, %d channels", spec.width,
			                  spec.height, spec.depth, spec.nchannels);
		if (spec.deep)
			return err_report(
				ERR_INPUT, path,
				"is not supported: part %d is deep, and several samples a pixel are no picture yet",
				part);
		if (spec.full_x != first.full_x || spec.full_y != first.full_y || spec.full_width != first.full_width ||
		    spec.full_height != first.full_height)
			return err_report(ERR_INPUT, path, "is not supported: part %d has another display window than the first one", part);
		out.x = std::min(out.x, spec.x);
		out.y = std::min(out.y, spec.y);
		x1 = std::max(x1, int64_t(spec.x) + spec.width);
		y1 = std::max(y1, int64_t(spec.y) + spec.height);
		out.n_parts++;
	}
	if (x1 - out.x > most || y1 - out.y > most || (x1 - out.x) * (y1 - out.y) > most)
		return err_report(ERR_INPUT, path, "is not supported: its parts lie %lld x %lld pixels apart",
		                  (long long)(x1 - out.x), (long long)(y1 - out.y));
	out.width = int(x1 - out.x);
	out.height = int(y1 - out.y);
	return in.seek_subimage(0, 0) ? 0 : err_report(ERR_INPUT, path, "%s", in.geterror().c_str());
}

int read_image(struct image *img, const char *path)
{
	OIIO::ImageSpec config;

	if (int err = heads_check(path))
		return err;
	/* Keep values as stored: colours of transparent pixels must not be premultiplied. */
	config.attribute("oiio:UnassociatedAlpha", 1);
	auto in = OIIO::ImageInput::open(path, &config);
	if (!in)
		return err_report(ERR_INPUT, path, "%s", OIIO::geterror().c_str());
	const OIIO::ImageSpec first = in->spec();
	const int64_t most = most_pixels(in->format_name(), OIIO::Filesystem::file_size(path));
	const bool all_parts = strcmp(in->format_name(), "openexr") == 0; /* pages of a TIFF are separate pictures */

	windows all;

	if (int err = find_windows(*in, all_parts, most, all, path))
		return err;
	img->width = uint32_t(all.width);
	img->height = uint32_t(all.height);
	for (int part = 0; part < all.n_parts && in->seek_subimage(part, 0); part++) {
		const OIIO::ImageSpec spec = in->spec();

		if (!has_room(all, spec.nchannels))
			return err_report(ERR_INPUT, path,
			                  "%d x %d pixels of %d channels take more memory than there is", all.width,
			                  all.height, spec.nchannels);
		std::vector<channel> channels;
		int err = add_part(img, spec, prefix_of(spec, part), all_parts, channels, path);
		if (!err)
			err = read_part(*in, spec, part, all, channels, path);
		if (err)
			return err;
	}
	if (int err = add_attributes(img, first))
		return err;
	/* Record the position of the data window for place.h. */
	if (all.x == first.full_x && all.y == first.full_y && all.width == first.full_width && all.height == first.full_height)
		return 0;
	return image_set_attribute(img, "relume:window", "%d %d %d %d", all.x - first.full_x, all.y - first.full_y,
	                           first.full_width, first.full_height);
}

int encode(const struct oiio_pixels *pixels, const struct oiio_coding *coding, uint8_t **out, size_t *out_bytes)
{
	const std::string name = std::string("memory.") + coding->format;
	std::vector<unsigned char> bytes;
	OIIO::Filesystem::IOVecOutput proxy(bytes);
	auto file = OIIO::ImageOutput::create(name, &proxy);
	OIIO::ImageSpec spec(int(pixels->width), int(pixels->height), 3, OIIO::TypeDesc::UINT8);

	if (strcmp(coding->format, "png") == 0) {
		spec.attribute("png:compressionLevel", coding->level);
	} else {
		spec.attribute("Compression", "jpeg:" + std::to_string(coding->quality));
		spec.attribute("jpeg:subsampling", "4:4:4");
	}
	spec.attribute("oiio:ColorSpace", "sRGB");
	if (coding->text)
		spec.attribute("ImageDescription", coding->text);
	if (!file || !file->open(name, spec) || !file->write_image(OIIO::TypeDesc::UINT8, pixels->rgb) || !file->close())
		return err_report(ERR_SYSTEM, NULL, "%s: %s", coding->format,
		                  file ? file->geterror().c_str() : OIIO::geterror().c_str());
	*out = static_cast<uint8_t *>(malloc(bytes.size() ? bytes.size() : 1));
	if (!*out)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	memcpy(*out, bytes.data(), bytes.size());
	*out_bytes = bytes.size();
	return 0;
}

} // namespace

pid_t oiio_fork(void)
{
	OIIO::thread_pool *pool = OIIO::default_thread_pool();

	in_use.lock();
	const int n_threads = pool->size();
	/* end its threads and wait for them: a child would have their locks but not the threads */
	pool->~thread_pool();
	const pid_t process = fork();
	new (pool) OIIO::thread_pool(process ? n_threads : 0);
	if (process == 0) {
		new (&in_use) std::shared_mutex; /* a new one: its owner's number differs in the child */
		return 0;
	}
	in_use.unlock();
	if (process < 0)
		err_report(ERR_SYSTEM, nullptr, "no process to read pictures in: %s", strerror(errno));
	return process;
}

int oiio_read(struct image *img, const char *path)
{
	const std::shared_lock<std::shared_mutex> here(in_use);

	try {
		int err = read_image(img, path);

		if (err)
			image_free(img);
		return err;
	} catch (const std::exception &e) {
		image_free(img);
		return err_report(ERR_SYSTEM, path, "%s", e.what());
	}
}

int oiio_encode(const struct oiio_pixels *pixels, const struct oiio_coding *coding, uint8_t **out, size_t *out_bytes)
{
	const std::shared_lock<std::shared_mutex> here(in_use);

	try {
		return encode(pixels, coding, out, out_bytes);
	} catch (const std::exception &e) {
		return err_report(ERR_SYSTEM, NULL, "%s: %s", coding->format, e.what());
	}
}

int oiio_draw_text(const struct oiio_pixels *pixels, const struct oiio_label *label)
{
	const std::shared_lock<std::shared_mutex> here(in_use);

	try {
		OIIO::ImageBuf buf(OIIO::ImageSpec(int(pixels->width), int(pixels->height), 3, OIIO::TypeDesc::UINT8), pixels->rgb);
		const float color[3] = { label->rgb[0] / 255.0f, label->rgb[1] / 255.0f, label->rgb[2] / 255.0f };

		return OIIO::ImageBufAlgo::render_text(buf, label->x, label->y, label->text, label->size, FONT, color) ?
		               0 :
		               ERR_SYSTEM;
	} catch (const std::exception &) {
		return ERR_SYSTEM;
	}
}

int oiio_compare_yee(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, double *count)
{
	const std::shared_lock<std::shared_mutex> here(in_use);

	try {
		const OIIO::ImageSpec codes(int(width), int(height), 3, OIIO::TypeDesc::UINT8);
		OIIO::ImageBuf pics[2];

		for (int i = 0; i < 2; i++) {
			OIIO::ImageBuf wrapped(codes, const_cast<uint8_t *>(i ? b : a));

			/* compare_Yee needs its own copy as floats */
			if (!pics[i].copy(wrapped, OIIO::TypeDesc::FLOAT))
				return err_report(ERR_SYSTEM, NULL, "Yee's metric: %s", pics[i].geterror().c_str());
		}
		OIIO::ImageBufAlgo::CompareResults results;

		*count = OIIO::ImageBufAlgo::compare_Yee(pics[0], pics[1], results);
		return 0;
	} catch (const std::exception &e) {
		return err_report(ERR_SYSTEM, NULL, "Yee's metric: %s", e.what());
	}
}
