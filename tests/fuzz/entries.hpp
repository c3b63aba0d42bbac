#pragma once
// What libFuzzer and the replay test call: each takes any bytes, must return 0, and stops the program where the code
// under test breaks a promise. The corpus of fuzz_NAME is corpus/NAME.

#include <cstddef>
#include <cstdint>

namespace rs::fuzz {

// The bytes as an .rso file; once as they are, once with the checksums of header and table made to fit.
int fuzz_container(const std::uint8_t* data, std::size_t size);

// Chunks of an object, framed as chunk_soup.hpp says, in a container that is well formed: the checks behind the
// checksums.
int fuzz_object(const std::uint8_t* data, std::size_t size);

// The bytes as a transforms.json.
int fuzz_rig(const std::uint8_t* data, std::size_t size);

// The bytes as a Middlebury *_par.txt.
int fuzz_middlebury(const std::uint8_t* data, std::size_t size);

// The bytes as a world of VRML or X3D, by how they begin; behind the header of VRML 1.0; as XML, behind a "<".
int fuzz_vrml(const std::uint8_t* data, std::size_t size);
int fuzz_vrml1(const std::uint8_t* data, std::size_t size);
int fuzz_x3d(const std::uint8_t* data, std::size_t size);

// The bytes as a model: a glTF file (binary where it begins with "glTF"), an OBJ, and the MTL of a sound OBJ; each as a
// room and as an object to photograph.
int fuzz_gltf(const std::uint8_t* data, std::size_t size);
int fuzz_obj(const std::uint8_t* data, std::size_t size);
int fuzz_mtl(const std::uint8_t* data, std::size_t size);

// The bytes as a PLY, an object to photograph.
int fuzz_ply(const std::uint8_t* data, std::size_t size);

// The bytes as a frame of a sequence (extended OBJ), and as a frames.json.
int fuzz_sequence(const std::uint8_t* data, std::size_t size);

// The bytes as a photograph: JPEG or PNG, by how it begins.
int fuzz_image(const std::uint8_t* data, std::size_t size);

// The bytes as a video file; decodes at most 16 frames, none if they have more than 2^20 pixels.
int fuzz_film(const std::uint8_t* data, std::size_t size);

// The bytes as a photometric file: IES, and EULUMDAT.
int fuzz_luminaire(const std::uint8_t* data, std::size_t size);

// The bytes as a file of a display's walls, and as one of heads before them.
int fuzz_walls(const std::uint8_t* data, std::size_t size);

// The bytes as a datagram of a head tracker.
int fuzz_head(const std::uint8_t* data, std::size_t size);

// The bytes as a list of lights; what is read is written and read again.
int fuzz_lights(const std::uint8_t* data, std::size_t size);

// The bytes as the settings file of a segmentation network, and as its ONNX model. OpenCV's importer is not called.
int fuzz_network_settings(const std::uint8_t* data, std::size_t size);
int fuzz_onnx(const std::uint8_t* data, std::size_t size);

}  // namespace rs::fuzz
