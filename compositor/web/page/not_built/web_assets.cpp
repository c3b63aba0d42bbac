#include "compositor/web/page/web_assets.hpp"

namespace rs::web {

Result<WebAssets> web_assets() {
    return Error{"this rs-view was built without the web part; install emscripten, nodejs and npm, and build again"};
}

}  // namespace rs::web
