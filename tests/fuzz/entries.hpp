#pragma once
// Fuzz entry points called by libFuzzer and the replay test. Each accepts any bytes, must return 0, and aborts the
// program if the code under test violates its contract. The corpus of fuzz_NAME is corpus/NAME.

#include <cstddef>
#include <cstdint>

namespace rs::fuzz {

/// Reads the bytes as an .rso file: unchanged, and with corrected checksums of header and table.
int fuzz_container(const std::uint8_t* data, std::size_t size);

/// Reads chunks of an object, framed as in chunk_soup.hpp, in a well-formed container, to test the checks after the
/// checksums.
int fuzz_object(const std::uint8_t* data, std::size_t size);

/// Reads a transforms.json, and converts its frame and axes.
int fuzz_rig(const std::uint8_t* data, std::size_t size);

/// Finds rows in the names of photos, one name a line.
int fuzz_photo_rows(const std::uint8_t* data, std::size_t size);

/// Reads a Middlebury *_par.txt.
int fuzz_middlebury(const std::uint8_t* data, std::size_t size);

/// Reads the cameras and images of a COLMAP model, as text or binary.
int fuzz_colmap(const std::uint8_t* data, std::size_t size);

/// Reads a VRML or X3D world, depending on the first bytes; also after the header of VRML 1.0; as XML after a "<".
int fuzz_vrml(const std::uint8_t* data, std::size_t size);
int fuzz_vrml1(const std::uint8_t* data, std::size_t size);
int fuzz_x3d(const std::uint8_t* data, std::size_t size);

/// Reads a glTF file (binary if it begins with "glTF"), an OBJ, and the MTL of a valid OBJ; each as a room and as an
/// object to be captured.
int fuzz_gltf(const std::uint8_t* data, std::size_t size);
int fuzz_obj(const std::uint8_t* data, std::size_t size);
int fuzz_mtl(const std::uint8_t* data, std::size_t size);

/// Reads a PLY as an object to be captured.
int fuzz_ply(const std::uint8_t* data, std::size_t size);

/// Reads a frame of a sequence (extended OBJ), and a frames.json.
int fuzz_sequence(const std::uint8_t* data, std::size_t size);

/// Reads a photo: JPEG or PNG, depending on the first bytes.
int fuzz_image(const std::uint8_t* data, std::size_t size);

/// Reads a video file; decodes at most 16 frames, none if they have more than 2^20 pixels.
int fuzz_film(const std::uint8_t* data, std::size_t size);

/// Reads a photometric file: IES, and EULUMDAT.
int fuzz_luminaire(const std::uint8_t* data, std::size_t size);

/// Reads a file of a display's walls, and a file of viewers' heads.
int fuzz_walls(const std::uint8_t* data, std::size_t size);

/// Reads a datagram of a head tracker.
int fuzz_head(const std::uint8_t* data, std::size_t size);

/// Reads a stream of messages of a leading rs-view.
int fuzz_sharing(const std::uint8_t* data, std::size_t size);

/// Reads a list of lights, writes it and reads it again.
int fuzz_lights(const std::uint8_t* data, std::size_t size);

/// Reads the settings file of a segmentation network, and its ONNX model. OpenCV's importer is not called.
int fuzz_network_settings(const std::uint8_t* data, std::size_t size);
int fuzz_onnx(const std::uint8_t* data, std::size_t size);

}  // namespace rs::fuzz
