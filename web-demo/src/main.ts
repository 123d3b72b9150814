// The page. `window.pliantDemo` is the hook of tests/page (see hook.ts).
import { App } from "./app.ts";
import { installHook } from "./hook.ts";
import { byId } from "./ui/dom.ts";

try {
  const app = await App.start();
  installHook(app);
} catch (error) {
  const notice = byId("notice");
  notice.hidden = false;
  notice.querySelector("span")!.textContent =
    `The page could not start: ${error instanceof Error ? error.message : String(error)}`;
  throw error;
}
