// Writes the files that the fuzz targets start from: fuzz_seeds FOLDER makes FOLDER/TARGET/NAME. Each is
// whole and small, so that single changed bytes reach deep into the readers.
#include "deflated.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using slicelens::deflated;

namespace {

fs::path root;

void seed(const std::string& target, const std::string& name, const std::string& bytes) {
  fs::create_directories(root / target);
  std::ofstream(root / target / name, std::ios::binary) << bytes;
}

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

template <class T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
}

const std::string& voxels() {
  static const std::string bytes = bytes_of(std::vector<std::int16_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  return bytes;
}

std::string listed(const std::string& bytes, std::size_t count) {
  return bytes_of(std::vector<std::uint64_t>{count}) + bytes;
}

/// A header of 3 x 2 x 2 shorts behind one brick of 24 bytes of 0, as tests/fuzz/bricks.cpp takes it.
void bricks() {
  const std::string voxel_bytes(24, '\0');
  const auto checksum =
      static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(voxel_bytes.data()), 24));
  const std::string header =
      listed("a.nrrd", 6) + listed("abc", 3) + listed("frame 0", 7) +
      bytes_of(std::vector<std::uint64_t>{3, 2, 2}) + '\3' +
      bytes_of(std::vector<double>{1, 1, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
      bytes_of(std::vector<std::uint64_t>{1}) + listed("NRRD", 4) + '\1' +
      listed(bytes_of(std::vector<std::uint32_t>{checksum}), 1) + bytes_of(std::vector<double>{0, 0, 0}) +
      bytes_of(std::vector<std::uint64_t>{0, 2}) + listed(bytes_of(std::vector<float>{0}), 1) +
      listed(bytes_of(std::vector<float>{0}), 1) + listed(bytes_of(std::vector<double>(12, 0.0)), 12);
  seed("bricks", "header", '\1' + bytes_of(std::vector<std::uint64_t>{88}) + header);
}

void nrrd() {
  const std::string head = "NRRD0005\ntype: short\nendian: little\nspace: right-anterior-superior\n";
  const std::string cube =
      "dimension: 3\nsizes: 3 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (4,5,6)\n"
      "kinds: domain domain domain\nspace units: \"mm\" \"mm\" \"mm\"\n";
  const std::string text = "0 1 2 3 4 5 6 7 8 9 10 11\n";
  seed("nrrd", "raw", head + cube + "encoding: raw\n\n" + voxels());
  seed("nrrd", "gzip", head + cube + "encoding: gzip\n\n" + deflated(voxels(), true));
  seed("nrrd", "ascii", head + cube + "encoding: ascii\n\n" + text);
  seed("nrrd", "hex", head + cube + "encoding: hex\n\n000001000200030004000500060007000800090010001100\n");
  seed("nrrd", "bzip2", head + cube + "encoding: bzip2\n\nBZh91AY&SY");
  seed("nrrd", "frames",
       "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 2 2 2\nspacings: 1 1 1 nan\n"
       "kinds: space space space time\nunits: \"mm\" \"um\" \"mm\" \"s\"\nencoding: raw\n\n" +
           voxels());
  seed("nrrd", "colour",
       "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 2 2 2\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
       "kinds: RGB-color domain domain domain\nkey:=value\nencoding: raw\nline skip: 0\nbyte skip: 0\n\n" +
           voxels());
  const std::string bytes =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 6\naxis mins: 0 0 0\nspacings: 1 2 3\n"
      "encoding: raw\n";
  seed("nhdr", "file", bytes + "byte skip: -1\ndata file: data.raw\n");
  seed("nhdr", "pattern",
       "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 6 2\nencoding: raw\ndata file: slice%d.raw 1 2 1 2\n");
  seed("nhdr", "list",
       "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 6 2\nencoding: raw\nbyte skip: 0\ndata file: LIST\n"
       "slice1.raw\nslice2.raw\n");
}

void meta() {
  const std::string head =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
      "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 4 5 6\nElementSpacing = 1 1 2\nDimSize = 3 2 2\n"
      "ElementType = MET_SHORT\n";
  seed("mha", "raw", head + "ElementDataFile = LOCAL\n" + voxels());
  const std::string packed = deflated(voxels(), false);
  seed("mha", "zlib",
       head + "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()) +
           "\nElementDataFile = LOCAL\n" + packed);
  seed("mha", "colour",
       "NDims = 3\nDimSize = 2 2 2\nElementNumberOfChannels = 3\nElementType = MET_UCHAR\n"
       "ElementDataFile = LOCAL\n" +
           voxels());
  const std::string bytes = "ObjectType = Image\nNDims = 3\nDimSize = 4 6 2\nElementType = MET_UCHAR\n";
  seed("mhd", "file", bytes + "HeaderSize = -1\nElementDataFile = data.raw\n");
  seed("mhd", "list", bytes + "ElementDataFile = LIST\nslice1.raw\nslice2.raw\n");
  seed("mhd", "pattern", bytes + "ElementDataFile = slice%d.raw 1 2 1\n");
}

void nifti() {
  std::string h(352, '\0');
  put<std::int32_t>(h, 0, 348);
  const std::vector<std::int16_t> dim = {3, 3, 2, 2, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) {
    put<std::int16_t>(h, 40 + 2 * i, dim[i]);
    put<float>(h, 76 + 4 * i, 1.0F);
  }
  put<std::int16_t>(h, 70, 4);
  put<std::int16_t>(h, 72, 16);
  put<float>(h, 108, 352.0F);
  put<float>(h, 112, 2.0F);
  h[123] = 2;
  put<std::int16_t>(h, 252, 1);
  std::memcpy(h.data() + 344, "n+1", 4);
  seed("nii", "one", h + voxels());
  put<std::int16_t>(h, 254, 1);
  for (std::size_t i = 0; i < 3; ++i)
    put<float>(h, 280 + 20 * i, 1.5F);
  put<float>(h, 284, 0.5F);
  seed("nii", "sheared", h + voxels());
  put<std::int16_t>(h, 40, 5);
  put<std::int16_t>(h, 46, 1);
  put<std::int16_t>(h, 50, 2);
  seed("nii", "gzip_vector", deflated(h + voxels(), true));
  std::string two(544, '\0');
  put<std::int32_t>(two, 0, 540);
  std::memcpy(two.data() + 4, "n+2\0\r\n\032\n", 8);
  put<std::int16_t>(two, 12, 4);
  for (std::size_t i = 0; i < 8; ++i) {
    put<std::int64_t>(two, 16 + 8 * i, dim[i]);
    put<double>(two, 104 + 8 * i, 1.0);
  }
  put<std::int64_t>(two, 168, 544);
  seed("nii", "two", two + voxels());
}

void vtk() {
  const std::string head = "# vtk DataFile Version 3.0\ntitle\n";
  const std::string grid =
      "DATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nSPACING 1 1 2\nORIGIN 4 5 6\nPOINT_DATA 12\n"
      "SCALARS values short 1\nLOOKUP_TABLE default\n";
  seed("vtk", "binary", head + "BINARY\n" + grid + voxels());
  seed("vtk", "ascii", head + "ASCII\n" + grid + "0 1 2 3 4 5 6 7 8 9 10 11\n");
  const auto vti = [](const std::string& attributes, const std::string& array, const std::string& inside,
                      const std::string& after) {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" " +
           attributes +
           "><ImageData WholeExtent=\"0 2 0 1 0 1\" Origin=\"0 0 0\" Spacing=\"1 1 2\" Direction=\"1 0 0 0 1 "
           "0 0 0 1\">"
           "<Piece Extent=\"0 2 0 1 0 1\"><PointData Scalars=\"a\"><DataArray type=\"Int16\" Name=\"a\" " +
           array + ">" + inside + "</DataArray></PointData></Piece></ImageData>" + after + "</VTKFile>\n";
  };
  seed("vti", "ascii", vti("", "format=\"ascii\"", "0 1 2 3 4 5 6 7 8 9 10 11", ""));
  seed("vti", "base64", vti("", "format=\"binary\"", "GAAAAAAAAQACAAMABAAFAAYABwAIAAkACgALAA==", ""));
  const std::string size = bytes_of(std::vector<std::uint32_t>{24});
  seed("vti", "appended",
       vti("header_type=\"UInt32\"", "format=\"appended\" offset=\"0\"", "",
           "<AppendedData encoding=\"raw\">_" + size + voxels() + "</AppendedData>"));
  const std::string packed = deflated(voxels(), false);
  const std::string blocks =
      bytes_of(std::vector<std::uint32_t>{1, 24, 0, static_cast<std::uint32_t>(packed.size())});
  seed("vti", "zlib",
       vti("compressor=\"vtkZLibDataCompressor\"", "format=\"appended\" offset=\"0\"", "",
           "<AppendedData encoding=\"raw\">_" + blocks + packed + "</AppendedData>"));
}

std::string chunk(const std::string& type, const std::string& data) {
  const auto big = [](std::uint32_t n) {
    return std::string{static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8),
                       static_cast<char>(n)};
  };
  const std::string body = type + data;
  const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big(static_cast<std::uint32_t>(data.size())) + body + big(static_cast<std::uint32_t>(crc));
}

void images() {
  const std::string mark = "\x89PNG\r\n\x1a\n";
  for (const char kind : std::string("\0\2\3\4\6", 5)) {
    const std::size_t channels = kind == 2 ? 3 : kind == 4 ? 2 : kind == 6 ? 4 : 1;
    const std::string size = {0, 0, 0, 3, 0, 0, 0, 2, 8, kind, 0, 0, 0};
    std::string rows;
    for (int row = 0; row < 2; ++row)
      rows += std::string(1, '\0') + std::string(3 * channels, '\1');
    const std::string palette = kind == 3 ? chunk("PLTE", "abcdef") : "";
    seed("png", "kind" + std::to_string(kind),
         mark + chunk("IHDR", size) + palette + chunk("IDAT", deflated(rows, false)) + chunk("IEND", ""));
  }
  const std::string sixteen = {0, 0, 0, 3, 0, 0, 0, 2, 16, 0, 0, 0, 0};
  seed("png", "sixteen",
       mark + chunk("IHDR", sixteen) + chunk("IDAT", deflated(std::string(14, '\0'), false)) +
           chunk("IEND", ""));
  // A baseline JPEG of 8 × 8 grey pixels with a table of one code (ITU-T T.81, Annex B).
  std::string jpeg = "\xff\xd8\xff\xdb";
  jpeg += std::string("\0\x43\0", 3) + std::string(64, '\1');
  jpeg += std::string("\xff\xc0\0\x0b\x08\0\x08\0\x08\1\1\x11\0", 13);
  jpeg += std::string("\xff\xc4\0\x14\0\1", 6) + std::string(15, '\0') + std::string(1, '\0');
  jpeg += std::string("\xff\xc4\0\x14\x10\1", 6) + std::string(15, '\0') + std::string(1, '\0');
  jpeg += std::string("\xff\xda\0\x08\1\1\0\0\x3f\0\x3f\xff\xd9", 13);
  seed("jpg", "grey", jpeg);
}

std::string element(std::uint16_t group, std::uint16_t number, const std::string& vr, std::string value) {
  if (value.size() % 2 == 1)
    value += ' ';
  std::string bytes = bytes_of(std::vector<std::uint16_t>{group, number}) + vr;
  if (vr == "OW" || vr == "SQ")
    return bytes + std::string(2, '\0') +
           bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value.size())}) + value;
  return bytes + bytes_of(std::vector<std::uint16_t>{static_cast<std::uint16_t>(value.size())}) + value;
}

void dicom() {
  const auto us = [](std::uint16_t number, std::uint16_t value) {
    return element(0x28, number, "US", bytes_of(std::vector<std::uint16_t>{value}));
  };
  const auto item = [](const std::string& inside) {
    return bytes_of(std::vector<std::uint16_t>{0xfffe, 0xe000}) +
           bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(inside.size())}) + inside;
  };
  const std::string shared =
      element(0x5200, 0x9229, "SQ",
              item(element(0x28, 0x9110, "SQ", item(element(0x28, 0x30, "DS", "0.75\\0.5"))) +
                   element(0x20, 0x9116, "SQ", item(element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0")))));
  const auto file = [&](const std::string& syntax, const std::string& rest) {
    return std::string(128, '\0') + "DICM" + element(2, 0x10, "UI", syntax) + rest;
  };
  const std::string body = element(8, 8, "CS", "ORIGINAL\\PRIMARY") + element(8, 0x18, "UI", "1.2.3") +
                           element(0x20, 0x0e, "UI", "1.2.3.1") + element(0x20, 0x32, "DS", "4\\5\\6") +
                           element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") + us(2, 1) +
                           element(0x28, 8, "IS", "2") + us(0x10, 2) + us(0x11, 3) + us(0x100, 16) +
                           us(0x101, 16) + us(0x102, 15) + us(0x103, 1) + element(0x28, 0x1052, "DS", "-10") +
                           shared + element(0x7fe0, 0x10, "OW", voxels());
  seed("dicom", "explicit", file("1.2.840.10008.1.2.1", body));
  std::string deflate = deflated(body, false);
  seed("dicom", "deflated", file("1.2.840.10008.1.2.1.99", deflate.substr(2, deflate.size() - 6)));
}

void texts() {
  seed("scene", "points",
       "{ \"volume\": { \"phantom\": \"head\", \"size\": [8, 8, 8] }, // a comment\n"
       "\"transfer\": { \"points\": [[0, 0, 0, 0, 0], [100, 1, 1, 1, 0.5]] }, \"camera\": { \"azimuth\": 30 "
       "} }");
  seed("scene", "warps",
       "{ \"warp\": [{ \"kind\": \"lamar\", \"zoom\": 4 }, { \"kind\": \"twist\", \"angle\": 30 }], "
       "\"render\": { "
       "\"pipeline\": \"fragment\", \"mode\": \"dvr\", \"size\": [64, 64] } }");
  seed("scene", "set", "render.spacing=0.5\n");
  seed("scene", "picture",
       "{ \"image\": { \"checkerboard\": { \"size\": [8, 8] } }, \"warp\": { \"zoom\": 2 } }");
  seed("landmarks", "pairs", std::string(1, '\0') + "[[[0,0,0],[1,1,1]],[[1,2,3],[4,5,6]]]");
  seed("landmarks", "csv", std::string(1, '\1') + "sx,sy,sz,tx,ty,tz\n# note\n0,0,0,1,1,1\n1,2,3,4,5,6\n");
  seed("landmarks", "fcsv",
       std::string(1, '\2') + "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
                              "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
                              "1,10,20,30,0,0,0,1,1,1,0,F-1,,\n");
  seed("landmarks", "slicer",
       std::string(1, '\3') + "{\"markups\":[{\"type\":\"Fiducial\",\"coordinateSystem\":\"RAS\","
                              "\"controlPoints\":[{\"id\":\"1\",\"position\":[1,2,3]}]}]}");
  seed("raw_name", "x", "foot_4x4x4_uint8");
  seed("raw_name", "underscore", "head-4_4_2-ushort");
}

/// A volume property of 3D Slicer as .vp.json with this component.
std::string slicer_property(const std::string& component) {
  return "{\"@schema\":\"x\",\"volumeProperties\":[{\"interpolationType\":\"linear\",\"components\":[{" +
         component + "}]}]}";
}

std::string camera_property(const std::string& name, const std::vector<std::string>& values) {
  std::string text = "<Property name=\"" + name + "\">";
  for (std::size_t i = 0; i < values.size(); ++i)
    text += "<Element index=\"" + std::to_string(i) + "\" value=\"" + values[i] + "\"/>";
  return text + "</Property>";
}

/// The first byte is the format's number in transfer_and_camera.cpp.
void transfers() {
  const auto add = [](char format, const std::string& name, const std::string& text) {
    seed("transfer", name, std::string(1, format) + text);
  };
  add(0, "json",
      R"([{"ColorSpace":"RGB","Name":"two","Points":[0,0.25,0.5,0,5,0,0.2,1,10,0.75,0.5,0.5],)"
      R"("RGBPoints":[0,0,0,0,5,1,0,0,5,0,1,0,10,1,0.5,0.25],"NanColor":[1,1,0]}])");
  add(0, "json_diverging",
      R"({"ColorSpace":"Diverging","RGBPoints":[1,0.2,0.3,0.75,10,0.7,0,0.15],"UseLogScale":1})");
  add(0, "json_hsv", R"({"ColorSpace":"HSV","HSVWrap":true,"RGBPoints":[-1,0,0,1,1e3,1,0,0]})");
  add(1, "xml",
      R"(<ColorMaps><ColorMap name="a" space="Lab"><Point x="0" o="0.5" r="0" g="0" b="1"/>)"
      R"(<Point x="9" o="1" r="1" g="0.5" b="0"/><NaN r="1" g="1" b="0"/></ColorMap></ColorMaps>)");
  add(1, "xml_one",
      R"(<ColorMap space="Wrapped" indexedLookup="false"><Point x="-1" r="1" g="0" b="0"/></ColorMap>)");
  add(2, "vp",
      "1\n1\n0.9\n0.1\n0.2\n10\n6 -100 0 20 0.25 300 1\n4 0 1 255 0.5\n8 -100 0 0 0 300 1 0.5 0.25\n");
  add(3, "vp_json",
      slicer_property(
          R"("shade":true,"lighting":{"ambient":0.1,"diffuse":0.9,"specular":0.2,"specularPower":10},)"
          R"("scalarOpacityUnitDistance":0.75,"scalarOpacity":{"points":[{"x":0,"y":0,"midpoint":0.3,)"
          R"("sharpness":0.5},{"x":4,"y":1}]},"gradientOpacity":{"points":[{"x":0,"y":1}]},)"
          R"("rgbTransferFunction":{"points":[{"x":0,"color":[1,0.5,0]},{"x":4,"color":[0,0,1]}]})"));
  add(4, "1dt", "3\n0 0 0 0\n1 0.5 0 0.25\n1 1 1 1\n");
  add(5, "pvcc",
      "<?xml version=\"1.0\"?><PVCameraConfiguration><Proxy>" +
          camera_property("CameraPosition", {"0", "-300", "5"}) +
          camera_property("CameraFocalPoint", {"0", "0", "0"}) +
          camera_property("CameraViewUp", {"0", "0", "1"}) + camera_property("CameraViewAngle", {"30"}) +
          camera_property("CameraParallelScale", {"80.5"}) +
          camera_property("CameraParallelProjection", {"0"}) + camera_property("EyeAngle", {"2"}) +
          "</Proxy></PVCameraConfiguration>");
}

} // namespace

int main(int count, char** words) {
  if (count != 2)
    return 2;
  root = words[1];
  bricks();
  nrrd();
  meta();
  nifti();
  vtk();
  images();
  dicom();
  texts();
  transfers();
  return 0;
}
